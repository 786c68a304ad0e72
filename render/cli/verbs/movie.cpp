// The verb `movie`: one scene becomes a film and the files beside it.
#include <fmt/format.h>

#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/text/reader.hpp"
#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/film_report.hpp"
#include "render/cli/report/record.hpp"
#include "render/cli/verbs/verb.hpp"
#include "render/run/movie_run.hpp"

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
        add_film(parser, film_,
                 "Folder of the run [output/ and the scene's name, numbered when that is taken]");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        const Scene scene = read_scene(scene_, sets_, measurable_in);
        const Plan plan = make_plan(scene);
        MovieRun movie(film_, reporter, scene, plan);
        return tell_folder(movie.run(), film_);
    }

  private:
    std::filesystem::path scene_;
    Assignments sets_;
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> movie_verb() {
    return std::make_unique<Movie>();
}

}  // namespace grainreel
