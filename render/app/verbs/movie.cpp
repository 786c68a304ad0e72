// The verb `movie`: one scene becomes a film and the files beside it.
#include <optional>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/handover/carry.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/report/record.hpp"
#include "render/app/verbs/page_of_run.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/app/watch/watch_child.hpp"
#include "render/film/run/engine_run.hpp"
#include "render/film/run/movie_run.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

class Movie final : public Verb {
  public:
    Movie()
        : Verb("movie", "Run a scene and make its film",
               fmt::format("The folder of the run goes to stdout, everything else to stderr. Ctrl-C ends the "
                           "film so that it\nplays and keeps the end state; a second one keeps the end state "
                           "alone, a third stops at once.\n{}",
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
                            "Let another engine run the scene, which is installed here, with mpirun: lammps "
                            "or liggghts [ours]")
                ->check(CLI::IsMember({key_of(PeerEngine::lammps), key_of(PeerEngine::liggghts)}))
                ->type_name("NAME");
        parser.add_option("--ranks", carry_.ranks, "With --engine: processes that share the work [1]")
            ->needs(engine)
            ->check(CLI::Range(1, 1000000))
            ->type_name("N");
        parser
            .add_option("--accept", accepted_,
                        "With --engine: `law`, a contact law that the engine lacks becomes the nearest that "
                        "it has")
            ->needs(engine)
            ->check(CLI::IsMember({"law"}))
            ->type_name("WHAT");
        parser
            .add_option("--law", law_,
                        "With --engine liggghts --ranks 1: `edinburgh`, Walton and Braun's law as it is")
            ->needs(engine)
            ->check(CLI::IsMember({"edinburgh"}))
            ->type_name("NAME");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        if (!no_page_) film_.page = page_of_ended_run();
        use_camera_file(camera_, sets_);
        const FilmedScene scene = read_filmed_scene(scene_, sets_, measurable_in);
        const Plan plan = plan_with_film(scene);
        keep_camera_file(camera_, scene.film.camera);
        if (!engine_.empty()) return run_elsewhere(scene, plan, reporter);
        std::optional<Listening> listening;
        if (watched_) listening.emplace(listen_at(place_));
        MovieRun movie(film_, reporter, scene, plan);
        std::optional<WatchChild> watch;
        if (listening) watch.emplace(movie.folder(), place_.host, std::move(*listening), report);
        return tell_folder(movie.run(), film_);
    }

  private:
    int run_elsewhere(const FilmedScene& scene, const Plan& plan, Reporter& reporter) {
        if (watched_) throw UserError("--watch: shows runs of our own engine; leave out --watch or --engine");
        carry_.engine = engine_ == key_of(PeerEngine::lammps) ? PeerEngine::lammps : PeerEngine::liggghts;
        carry_.accept_law = !accepted_.empty();
        carry_.edinburgh = !law_.empty();
        CarriedScene carried = carry(scene, plan, carry_);
        throw_refusals(carried);
        if (film_.film || film_.frames) want_pictures(carried, scene);
        EngineRun run(film_, reporter, scene, std::move(carried));
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
