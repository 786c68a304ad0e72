// The verb `render`: a finished run is drawn again, as a film or as one picture. Nothing is run.
#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/film_report.hpp"
#include "render/cli/report/record.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/verbs/verb.hpp"
#include "render/run/frames/recorded_run.hpp"
#include "render/run/redraw_run.hpp"
#include "render/run/still.hpp"

namespace grainreel {
namespace {

class Render final : public Verb {
  public:
    Render()
        : Verb(
              "render", "Draw a finished run again, without running it",
              fmt::format("RUN itself is never changed. The folder or file that was made goes to stdout.\n{}",
                          exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser.add_option("RUN", request_.run, "Folder of a run, with its scene.toml and trajectory.nc")
            ->required()
            ->type_name("DIR");
        add_sets(parser, request_.sets,
                 "Another value for a key of [film] or a species' colour, as in --set film.camera.azimuth=60 "
                 "or --set species.big.colour=orange; may be repeated");
        add_picture_keys(parser, request_.sets);
        CLI::Option* from =
            add_time(parser, "--from", request_.from, "First moment to draw [the run's first]");
        CLI::Option* to = add_time(parser, "--to", request_.to, "Last moment to draw [the run's last]");
        CLI::Option* every =
            parser.add_option("--every", request_.every, "Draw one of so many frames of the trajectory [1]")
                ->check(CLI::Range(1, 1000000000))
                ->type_name("N");
        CLI::Option* at = add_time(parser, "--at", request_.at,
                                   "Draw the frame nearest to this moment alone, to a PNG file");
        add_film(
            parser, film_,
            "Folder of the film [beside RUN, its name with -render]; with --at, the PNG file [beside RUN]");
        for (CLI::Option* other :
             {from, to, every, parser.get_option("--frames"), parser.get_option("--no-film")})
            at->excludes(other);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        RecordedRun record(request_.run, request_.sets);
        if (request_.at) {
            print_exact(draw_still(film_, *request_.at, reporter, record).string() + "\n");
            return 0;
        }
        record.leave_out_damaged();
        RedrawRun redraw(film_, request_, reporter, record);
        return tell_folder(redraw.run(), film_);
    }

  private:
    RenderRequest request_;
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> render_verb() {
    return std::make_unique<Render>();
}

}  // namespace grainreel
