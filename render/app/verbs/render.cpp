// The verb `render` draws a finished run again, as a film or as one picture. Moments that the run did not
// keep are brought back from its checkpoints; the run itself is not changed.

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/app/asked/asked_pictures.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/study/members/child.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/film_in_parts.hpp"
#include "render/film/run/follow_film.hpp"
#include "render/film/run/redraw_job.hpp"
#include "render/film/run/still.hpp"
#include "render/film/sources/stored_shots.hpp"

namespace grainreel {
namespace {

// Refuses keys of the film's segments together with --every, which draws the frames of the trajectory at
// their own pace.
void check_no_segments(const Assignments& sets) {
    for (const Assignment& set : sets)
        if (set.key().rfind("film.segment", 0) == 0)
            throw UserError(
                "{}: --every draws the frames of the trajectory one after the other, "
                "without segments; leave one of the two out",
                set.place());
}

class Render final : public Verb {
  public:
    Render()
        : Verb(
              "render", "Draw a finished run again, without running it",
              fmt::format("RUN itself is never changed. The folder or file that was made goes to stdout.\n{}",
                          exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option(
                "RUN", request_.run,
                "Folder of a run, with its scene.toml and trajectory.nc; or files of another program: a "
                "file, a quoted pattern or a folder")
            ->required()
            ->type_name("PATH");
        add_sets(parser, request_.sets,
                 "Another value for a key of [film] or a species' colour, as in --set film.camera.azimuth=60 "
                 "or --set species.big.colour=orange; may be repeated");
        add_picture_keys(parser, request_.sets);
        CLI::Option* from =
            add_time(parser, "--from", request_.from, "First moment to draw [the film's first]");
        CLI::Option* to = add_time(parser, "--to", request_.to, "Last moment to draw [the film's last]");
        CLI::Option* every =
            parser
                .add_option("--every", request_.every,
                            "Draw every Nth frame of the trajectory, in place of the film's pictures")
                ->check(CLI::Range(1, 1000000000))
                ->type_name("N");
        CLI::Option* at =
            add_time(parser, "--at", request_.at, "Draw only this moment, to a PNG or PDF file");
        CLI::Option* frame = parser
                                 .add_option("--frame", request_.frame,
                                             "Draw only this frame, counted from 0, of the film or of the "
                                             "files of another program, to a PNG file")
                                 ->type_name("N")
                                 ->excludes(at);
        CLI::Option* cycle =
            parser
                .add_option("--cycle", request_.cycle,
                            "Draw only this moment, in periods of the drive, as in 40, to a PNG file")
                ->type_name("N")
                ->check(number_within(0, 1e9))
                ->excludes(at)
                ->excludes(frame);
        parser
            .add_option("--phase", request_.phase,
                        "With --cycle: part of the period that has passed, from 0 to 1 [0]")
            ->type_name("TURNS")
            ->check(number_within(0, 1))
            ->needs(cycle);
        CLI::Option* asked =
            parser.add_flag("--asked", asked_,
                            "Draw pictures that another program asks for on stdin, and write them to stdout "
                            "(docs/guide/python.md)");
        add_print_size(parser, request_.print);
        add_camera_file(parser, camera_);
        add_no_replay(parser, request_.replay);
        add_reading(parser, reading_);
        CLI::Option* follow = parser.add_flag(
            "--follow", follow_,
            "Film files of another program, or a scene that was handed over, while they grow: until the job "
            "ends, nothing new comes, or Ctrl-C");
        add_time(parser, "--idle", idle_,
                 "With --follow: end the film after this time without a new frame, as in 30s [60 s]")
            ->needs(follow);
        for (CLI::Option* other : {at, frame, cycle, from, to, every}) follow->excludes(other);
        add_parts(parser, request_.parts, slurm_);
        for (const char* other : {"--part", "--parts", "--slurm"})
            for (CLI::Option* one : {follow, at, frame, cycle}) one->excludes(parser.get_option(other));
        add_film(parser, film_,
                 "Folder of the film [beside RUN, its name with -render]; with --at, the PNG or PDF file "
                 "[beside RUN]");
        for (CLI::Option* other :
             {from, to, every, parser.get_option("--frames"), parser.get_option("--no-film")})
            for (CLI::Option* one : {at, frame, cycle}) one->excludes(other);
        for (CLI::Option* other :
             {at, frame, cycle, from, to, every, follow, parser.get_option("--part"),
              parser.get_option("--parts"), parser.get_option("--slurm"), parser.get_option("--out"),
              parser.get_option("--pdf"), parser.get_option("--frames"), parser.get_option("--no-film"),
              parser.get_option("--keep-camera")})
            asked->excludes(other);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        check_print_size(request_.print, is_still() || asked_, "--at, --frame or --cycle");
        check_idle();
        use_camera_file(camera_, request_.sets);
        film_.program = program_info();
        // The files may be large, or of a job that has not begun.
        if (is_still()) {
            check_still(film_, request_);
        } else if (film_.out && slurm_ == 0) {
            check_folder_name(*film_.out);
            RunFolder::check(*film_.out, film_.force);
        }
        if (follow_) return follow(reporter);
        const RunToRead read = run_to_read(request_.run, reading_, reporter);
        if (read.imported) {
            request_.beside = read.beside;
            request_.named = request_.run.string();
            request_.told = read.news;
        }
        request_.run = read.folder;
        request_.frame_of_file = read.imported;
        if (asked_) return draw_asked_pictures(film_, request_, reporter);
        if (read.imported && !is_still() && !request_.every) request_.every = 1;
        if (is_still()) return draw_one(reporter);
        if (request_.every) check_no_segments(request_.sets);
        StoredShots source(request_.run, request_.sets, request_.replay);
        source.check_all();
        keep_camera_file(camera_, source.scene().film.camera);
        if (slurm_ > 0) return tell_script(reporter, source);
        RedrawJob redraw(film_, request_, reporter, source);
        return tell_folder(redraw.run(), film_);
    }

  private:
    void check_idle() const {
        constexpr double least = 0.5, most = 1e6;
        if (idle_ && !(*idle_ >= least && *idle_ <= most))
            throw UserError("--idle: must be a time from {} s to {:.0f} s, but is {:.6g} s", least, most,
                            *idle_);
    }

    double idle() const { return idle_.value_or(60); }

    bool is_still() const { return request_.at || request_.frame || request_.cycle; }

    int follow(Reporter& reporter) const {
        const bool handed_over = is_handover(request_.run);
        if (const std::string option = given_reading(reading_); handed_over && !option.empty())
            throw UserError("{}: is for files of other programs, and {} was handed over by us", option,
                            request_.run.string());
        if (!handed_over && is_there(request_.run / "scene.toml"))
            throw UserError(
                "--follow: is for files of other programs; a run of ours is shown by: {} watch {}",
                program_call(), shell_word(request_.run.string()));
        FollowFilm film(film_, {request_.run, reading_, request_.sets, folder_holding(request_.run), idle()},
                        reporter);
        keep_camera_file(camera_, film.scene().film.camera);
        return tell_folder(film.run(), film_);
    }

    int draw_one(Reporter& reporter) {
        StoredShots source(request_.run, sets_for_still(request_.sets), request_.replay);
        if (request_.cycle) request_.at = time_of_cycle(request_, source.clock(), source.span().to);
        keep_camera_file(camera_, source.scene().film.camera);
        const auto file = draw_still(film_, request_, reporter, source);
        if (!file) return signal_base + reporter.stop_signal();
        print_exact(file->string() + "\n");
        return 0;
    }

    // Prints the script for Slurm, after checking for mistakes that would make every part fail.
    int tell_script(Reporter& reporter, StoredShots& source) {
        if (!film_.out) throw UserError("--slurm: the film needs a name; add --out film.mp4");
        if (!film_.film) throw UserError("--slurm: joins films; leave out --no-film");
        request_.parts = PartsWanted{1, slurm_};
        RedrawJob::check(film_, request_, reporter, source);
        if (source.scene().film.format == FilmFormat::png)
            throw UserError("--slurm: joins films, and format png has none; draw its parts by --part");
        check_joined(*film_.out, source.scene().film.format, film_.force);
        std::vector<std::string> absolute = typed_words;
        absolute.front() = own_program();
        print_exact(slurm_script(absolute, slurm_, std::filesystem::current_path(), *film_.out));
        return 0;
    }

    RenderRequest request_;
    int slurm_ = 0;  // number of parts of a Slurm script; 0: no script
    ReadingOptions reading_;
    CameraFiles camera_;
    bool follow_ = false, asked_ = false;
    std::optional<double> idle_;  // s
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> render_verb() {
    return std::make_unique<Render>();
}

}  // namespace grainreel
