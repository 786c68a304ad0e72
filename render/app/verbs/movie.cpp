// The verb `movie` runs a scene and makes its film and the files beside it.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/handover/carry.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/questions/discharge.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/report.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/movie_job.hpp"
#include "render/film/run/peer_job.hpp"
#include "render/film/sources/film_needs.hpp"
#include "render/page/live/server.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// A process of its own that shows the live page of the run which this process computes. So visitors slow the
// run no more than another program would. The page is made from the run's files alone.
class WatchChild {
  public:
    // Throws RunError when no process can be made.
    WatchChild(const std::filesystem::path& run, const std::string& host, Listening listening,
               const ReporterOptions& report);
    // Destroy it when the run is over. The destructor waits until the child has told its visitors so, which
    // takes a few seconds at most.
    ~WatchChild();
    WatchChild(const WatchChild&) = delete;
    WatchChild& operator=(const WatchChild&) = delete;

  private:
    pid_t process_ = -1;
    int alive_ = -1;  // our end of a pipe; when it closes, the child knows that we have ended
};

// Runs in the new process until `grainreel watch` replaces it. After fork() it may make system calls only.
// nothing: /dev/null, for stdin and stdout. The process gets a group of its own, so that Ctrl-C reaches only
// the run.
[[noreturn]] void become(char* const* words, int nothing, int socket, int alive, pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // the parent has died already
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
    ::fcntl(socket, F_SETFD, 0);
    ::fcntl(alive, F_SETFD, 0);
    ::execv("/proc/self/exe", words);
    ::_exit(127);
}

std::vector<std::string> words_of(const std::filesystem::path& run, const std::string& host, int socket,
                                  int alive, const ReporterOptions& report) {
    std::vector<std::string> words = {"grainreel",
                                      "watch",
                                      run.string(),
                                      "--watch-host",
                                      host,
                                      "--socket",
                                      std::to_string(socket),
                                      "--until",
                                      std::to_string(alive)};
    if (report.quiet) words.emplace_back("--quiet");
    if (report.form == ReporterOptions::Form::json) words.insert(words.end(), {"--progress", "json"});
    return words;
}

WatchChild::WatchChild(const std::filesystem::path& run, const std::string& host, Listening listening,
                       const ReporterOptions& report) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw RunError("--watch: no pipe: {}", std::strerror(errno));
    std::vector<std::string> words = words_of(run, host, listening.socket(), ends[0], report);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const pid_t parent = ::getpid();
    process_ = nothing < 0 ? -1 : ::fork();
    if (process_ == 0) become(pointers.data(), nothing, listening.socket(), ends[0], parent);
    const int why = errno;
    if (nothing >= 0) ::close(nothing);
    ::close(ends[0]);
    alive_ = ends[1];
    if (process_ > 0) return;
    ::close(alive_);
    throw RunError("--watch: no process for the page: {}", std::strerror(why));
}

WatchChild::~WatchChild() {
    ::close(alive_);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
}

class Movie final : public Verb {
  public:
    Movie()
        : Verb("movie", "Run a scene and make its film",
               fmt::format("The folder of the run goes to stdout, everything else to stderr. Ctrl-C ends "
                           "the run and leaves a\n"
                           "film that plays and the end state. A second Ctrl-C keeps only the end state, a "
                           "third stops at once.\n"
                           "{}",
                           exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        add_scene(parser, scene_, sets_);
        add_camera_file(parser, camera_);
        add_film(parser, film_,
                 "Folder of the run [output/ and the scene's name, numbered when that is taken]");
        parser.add_flag("--no-report", no_page_, "Leave out report.html, the run as a page for a browser");
        add_no_cache(parser, film_.keep_packings);
        add_watch(parser, watched_, place_);
        CLI::Option* engine =
            parser
                .add_option("--engine", engine_,
                            "Let another engine, installed on this machine, run the scene with mpirun: "
                            "lammps or liggghts [ours]")
                ->check(CLI::IsMember({key_of(PeerEngine::lammps), key_of(PeerEngine::liggghts)}))
                ->type_name("NAME");
        parser.add_option("--ranks", carry_.ranks, "With --engine: processes that share the work [1]")
            ->needs(engine)
            ->check(CLI::Range(1, 1000000))
            ->type_name("N");
        parser
            .add_option("--accept", accepted_,
                        "With --engine: `law` replaces a contact law that the engine lacks by the nearest "
                        "that it has")
            ->needs(engine)
            ->check(CLI::IsMember({"law"}))
            ->type_name("WHAT");
        parser
            .add_option("--law", law_,
                        "With --engine liggghts --ranks 1: `edinburgh` keeps the law of Walton and Braun")
            ->needs(engine)
            ->check(CLI::IsMember({"edinburgh"}))
            ->type_name("NAME");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        if (film_.out) check_folder_name(*film_.out);
        if (!watched_ && place_.host != WatchPlace().host)
            throw UserError("--watch-host: says where the page of --watch is shown; add --watch");
        if (!no_page_) film_.page = page_of_ended_run();
        use_camera_file(camera_, sets_);
        if (std::error_code none; std::filesystem::is_directory(scene_, none) && is_foreign(scene_))
            throw UserError("{}: holds files of another program, which cannot be run; `render {}` draws them",
                            scene_.string(), scene_.string());
        const FilmedScene scene = read_filmed_scene(scene_, sets_, measurable_in);
        const Plan plan = plan_with_film(scene);
        keep_camera_file(camera_, scene.film.camera);
        if (!engine_.empty()) return run_elsewhere(scene, plan, reporter);
        std::optional<Listening> listening;
        if (watched_) listening.emplace(listen_at(place_));
        MovieJob movie(film_, reporter, scene, plan);
        std::optional<WatchChild> watch;
        if (listening) watch.emplace(movie.folder(), place_.host, std::move(*listening), report);
        const FolderJob::Ended ended = movie.run();
        if (ended.exit_status == 0 && ended.folder)
            for (const std::string& line : discharge_lines(*ended.folder, scene)) reporter.info(line);
        return tell_folder(ended, film_);
    }

  private:
    int run_elsewhere(const FilmedScene& scene, const Plan& plan, Reporter& reporter) {
        if (watched_) throw UserError("--watch: shows runs of our own engine; leave out --watch or --engine");
        carry_.engine = engine_ == key_of(PeerEngine::lammps) ? PeerEngine::lammps : PeerEngine::liggghts;
        carry_.engine_option = "--engine";
        carry_.pack_option = "handover --pack-there";
        carry_.accept_law = !accepted_.empty();
        carry_.edinburgh = !law_.empty();
        const std::optional<std::string> lack =
            film_.film || film_.frames ? lacking_elsewhere(scene) : std::nullopt;
        if (lack) throw UserError("{}: --engine {}: {}", scene.file, engine_, *lack);
        CarriedScene carried = carry(scene, plan, carry_);
        throw_refusals(carried, [&](const std::string& line) { reporter.error(line); });
        if (film_.film || film_.frames) want_pictures(carried, scene);
        PeerJob run(film_, reporter, scene, std::move(carried));
        return tell_folder(run.run(), film_);
    }

    std::filesystem::path scene_;
    Assignments sets_;
    CameraFiles camera_;
    FilmRequest film_;
    std::string engine_, accepted_, law_;
    CarryRequest carry_;
    bool no_page_ = false, watched_ = false;
    WatchPlace place_;
};

}  // namespace

std::unique_ptr<Verb> movie_verb() {
    return std::make_unique<Movie>();
}

}  // namespace grainreel
