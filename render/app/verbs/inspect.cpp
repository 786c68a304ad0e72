// The verb `inspect` answers questions about a moment of a run. This file has its options and prints the
// answer; render/app/inspect/inspection.cpp finds the answer.
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "render/app/inspect/inspection.hpp"
#include "render/app/inspect/print_answer.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/answers/pictured_answer.hpp"

namespace grainreel {
namespace {

std::string about_columns() {
    std::string text =
        "Quantities of a grain, for --where and --histogram (write numbers with units, as in 2 cm). Those "
        "with * bring\n"
        "the moment back, which may take a while:\n";
    for (const GrainColumn& column : grain_columns())
        text += fmt::format("  {:<20}{}{}{}\n", column.name, column.needs == Needs::nothing ? "  " : "* ",
                            column.about,
                            column.also.empty() ? "" : fmt::format("; also called {}", column.also));
    return text +
           "Conditions are joined by and, or, not. touches(WHO) is true if the grain has a contact that "
           "carries force\n"
           "with WHO: any wall (touches(wall)), the name of a wall or species, or the id of a grain.\n";
}

class Inspect final : public Verb {
  public:
    Inspect()
        : Verb(
              "inspect", "Ask about one moment of a run: which grain is this, where are the big ones",
              "Without a question it shows the moment on one screen: the species, the grains that stand "
              "out, the tip of the\n"
              "bed, the forces on the walls, and what the run measured, such as segregation. A moment that "
              "the run did not\n"
              "keep is brought back from its checkpoints, and so are the forces.\n"
              "\n" +
                  about_columns() +
                  "\nExamples:\n"
                  "  grainreel inspect output/gravel --at 1.2s\n"
                  "  grainreel inspect output/gravel --at 1.2s --where \"species == big and height > 2 cm\"\n"
                  "  grainreel inspect output/gravel --at 1.2s --wall \"left slant\"\n"
                  "  grainreel inspect output/gravel --at 1.2s --grain 12 --png grain.png\n"
                  "\nExit status: 0 done, 2 a mistake in the options, or a run that cannot be read.") {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("RUN", asks_.run,
                        "Folder of a run, with its scene.toml and trajectory.nc; or a checkpoint, a "
                        "final.csv or a trajectory.nc alone; or files of another program")
            ->required()
            ->type_name("PATH");
        parser.option_defaults()->group("Moment");
        CLI::Option* at = add_time(parser, "--at", asks_.moment.at, "Moment [the run's last]");
        parser.add_option("--frame", asks_.moment.frame, "Moment of this frame of the film, counted from 0")
            ->type_name("N")
            ->excludes(at);
        CLI::Option* cycle =
            parser.add_option("--cycle", asks_.moment.cycle, "Moment in periods of the drive, as in 40");
        cycle->type_name("N")->excludes(at)->excludes(parser.get_option("--frame"));
        parser
            .add_option("--phase", asks_.phase,
                        "With --cycle: part of the period that has passed, from 0 to 1 [0]")
            ->type_name("TURN")
            ->needs(cycle)
            ->check(CLI::Range(0.0, 1.0));
        CLI::Option* average = parser
                                   .add_option("--average", asks_.average,
                                               "Mean over N periods up to the moment; with "
                                               "--largest-overlap, the largest of all these moments")
                                   ->type_name("N")
                                   ->check(CLI::Range(0.05, 1e6));
        parser.add_flag("--no-replay", asks_.no_replay, "Use only what was kept: the nearest kept moment");
        add_reading(parser, asks_.reading);
        parser.option_defaults()->group("Question (one of them; none: an overview)");
        add_questions(parser);
        parser.option_defaults()->group("Picture");
        add_time(parser, "--film-time", asks_.film_time,
                 "With --pixel or --png: time of the film, if its camera moves [that of --frame, else 0]");
        parser
            .add_option("--png", asks_.picture,
                        "Draw the moment too, with rings around the answer and all else pale; with --grain "
                        "and --wall, arrows for the forces on it")
            ->type_name("FILE")
            ->check(not_empty())
            ->excludes(average);
        add_gl(parser, asks_.gl);
        parser.get_option("--gl")->each([this](const std::string&) { gl_given_ = true; });
        add_sets(parser, asks_.sets,
                 "With --pixel or --png: another value for a key of [film], as for render; may be repeated");
        add_still_keys(parser, asks_.sets);
        parser.option_defaults()->group("Answer");
        parser.add_option("--limit", asks_.limit, "Most grains in a list [10]")
            ->type_name("N")
            ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
        CLI::Option* json = parser.add_flag("--json", asks_.json, "Answer as JSON, in SI units");
        parser.add_flag("--csv", asks_.csv, "Answer as CSV, in SI units")->excludes(json);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        if (!asks_.picture.empty()) check_picture_file(asks_.picture);
        check_options();
        asks_.sets = sets_for_still(std::move(asks_.sets), asks_.picture.empty() ? "--pixel" : "--png");
        const Answer answer = inspected(asks_, reporter);
        print_result(asks_.json ? json_of(answer) : asks_.csv ? csv_of(answer) : text_of(answer));
        if (asks_.csv) tell_beside(answer, reporter);
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    // Refuses combinations of options in which one would have no effect.
    void check_options() const {
        if (asks_.average && asks_.compare)
            throw UserError(
                "--average: --compare is between two moments, of which there is no mean; leave one out");
        if (asks_.over_time && !asks_.picture.empty())
            throw UserError("--over-time: --png is of one moment; leave one out");
        if (asks_.over_time && (asks_.moment.at || asks_.moment.frame || asks_.moment.cycle))
            throw UserError("--over-time: is of all kept moments; leave the moment out");
        if (asks_.every &&
            (!asks_.picture.empty() || asks_.moment.at || asks_.moment.frame || asks_.moment.cycle))
            throw UserError("--every: is of the whole run; leave moment and picture out");
        if (asks_.every && !(*asks_.every > 0)) throw UserError("--every: must be longer than 0 s");
        if (!asks_.mean.empty() && !asks_.series())
            throw UserError("--mean: is over time; add --every or --over-time");
        if (asks_.of_columns() && (!asks_.picture.empty() || asks_.average || asks_.moment.at ||
                                   asks_.moment.frame || asks_.moment.cycle))
            throw UserError("{}: is of the whole run; leave moment, mean and picture out",
                            asks_.steady           ? "--steady"
                            : asks_.discharge      ? "--discharge"
                            : asks_.parameters     ? "--parameters"
                            : asks_.fields.empty() ? "--measure"
                                                   : "--fields");
        if (windowed_ && asks_.columns.columns.empty() && asks_.fields.empty())
            throw UserError("--window: says which rows or records count; add --measure or --fields");
        if (asks_.average && !asks_.pixel.empty())
            throw UserError("--average: --pixel is of one picture, so there is no mean; leave one out");
        if (gl_given_ && asks_.picture.empty())
            throw UserError("--gl: says what draws the picture; add --png");
        if (asks_.film_time && !asks_.draws())
            throw UserError("--film-time: says what a picture shows; add --png or --pixel");
        if (asks_.film_time && *asks_.film_time < 0)
            throw UserError("--film-time: must be at least 0 s, the film's first frame");
        for (const Assignment& set : asks_.sets)
            if (!asks_.draws() && set.key() != "run.threads")
                throw UserError("{}: says how a picture is drawn; add --png or --pixel", set.place());
    }

    // Tells the moment and the notes on stderr, since a CSV table has no room for words.
    static void tell_beside(const Answer& answer, Reporter& reporter) {
        if (const std::string line = moment_line(answer); !line.empty()) reporter.info(line);
        for (const std::string& note : answer.notes) reporter.info(note);
    }

    void add_questions(CLI::App& parser) {
        std::vector<CLI::Option*> questions = {
            parser
                .add_option("--grain", asks_.grain,
                            "This grain: place, velocity, contacts, what pushes it, neighbours")
                ->type_name("ID"),
            parser
                .add_option(
                    "--wall", asks_.wall,
                    "This wall or mesh, as in floor, \"left slant\" or drum (the overview lists them): "
                    "force and torque on it, pressure by height, the grains that touch it, number of each "
                    "species")
                ->type_name("NAME"),
            parser.add_flag("--largest-overlap", asks_.largest_overlap, "The contacts that overlap most"),
            parser
                .add_option("--where", asks_.where, "Grains for which this is true: number, statistics, list")
                ->type_name("CONDITION"),
            parser
                .add_option("--profile", asks_.profile,
                            "Means in bins along height, x, y, z, or the distance r from the axis")
                ->type_name("DIRECTION"),
            parser
                .add_option("--slice", asks_.slice, "Grains that this plane cuts, as in y=0 or \"z = 2 cm\"")
                ->type_name("PLANE"),
            parser
                .add_option("--histogram", asks_.histogram,
                            "How many grains have a value in each of several bins")
                ->type_name("QUANTITY"),
            parser.add_flag("--pair-distribution", asks_.pairs,
                            "Radial distribution function of the centres"),
            add_time(parser, "--compare", asks_.compare,
                     "Which grains moved most between this time and the moment"),
            parser
                .add_option("--steady", asks_.steady,
                            "Whether this column of measures.csv is steady: where its transient ends, and "
                            "whether it drifts after that")
                ->type_name("COLUMN"),
            parser
                .add_option("--fields", asks_.fields,
                            "Means of fields.nc in a --window: on its own grid (kept), or over rings about "
                            "the axis (rz), with the turnover time of the flow")
                ->type_name("GRID")
                ->check(CLI::IsMember({"kept", "rz"})),
            parser.add_flag("--parameters", asks_.parameters,
                            "All parameters of the run, with what the plan chose, as a table"),
            parser.add_flag(
                "--discharge", asks_.discharge,
                "How fast grains flow out, when the vessel is empty, and what Beverloo's law expects"),
            parser
                .add_option(
                    "--measure", asks_.columns.columns,
                    "Mean, deviation and interval of these columns of measures.csv; see --window, --slope "
                    "and --by")
                ->type_name("COLUMN,...")
                ->delimiter(',')
                ->check(not_empty()),
            parser
                .add_option("--pixel", asks_.pixel,
                            "Which grain or wall is at this pixel of the film's picture")
                ->type_name("X,Y")
                ->delimiter(',')
                ->expected(2)};
        for (std::size_t i = 0; i < questions.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) questions[i]->excludes(questions[k]);
        parser
            .add_flag("--over-time", asks_.over_time,
                      "With --where: number of grains of each species at every kept moment")
            ->needs(parser.get_option("--where"))
            ->excludes(parser.get_option("--average"));
        add_time(parser, "--every", asks_.every,
                 "With --where: the same at each multiple of this time; these moments are brought back")
            ->needs(parser.get_option("--where"))
            ->excludes(parser.get_option("--average"))
            ->excludes(parser.get_option("--over-time"));
        parser
            .add_option("--mean", asks_.mean,
                        "With --every or --over-time: also the mean of this quantity over these grains")
            ->type_name("QUANTITY")
            ->needs(parser.get_option("--where"));
        CLI::Option* measure = parser.get_option("--measure");
        const auto window = [this](const char* option, const std::string& text) {
            try {
                asks_.columns.window = time_window(text);
            } catch (const UserError& mistake) {
                throw UserError("{}: {}", option, mistake.what());
            }
        };
        CLI::Option* in_window =
            parser
                .add_option_function<std::string>(
                    "--window",
                    [this, window](const std::string& text) {
                        windowed_ = true;
                        window("--window", text);
                    },
                    "With --measure or --fields: only what lies between these times, as in 0.2s..0.8s [all]")
                ->type_name("FROM..TO");
        parser
            .add_option_function<std::string>(
                "--slope",
                [this, window](const std::string& text) {
                    asks_.columns.slope = true;
                    window("--slope", text);
                },
                "With --measure: also the slope between these times, with its interval")
            ->type_name("FROM..TO")
            ->needs(measure)
            ->excludes(in_window);
        parser
            .add_option_function<std::string>(
                "--by", [this](const std::string&) { asks_.columns.by_period = true; },
                "With --measure: a row for each `period` of the drive")
            ->type_name("WHAT")
            ->check(CLI::IsMember({"period"}))
            ->needs(measure)
            ->excludes(parser.get_option("--slope"));
        parser.add_flag("--through", asks_.through, "With --pixel: also what lies behind it")
            ->needs(questions.back());
        parser.add_option("--bins", asks_.bins, "With --histogram: number of bins [20]")
            ->type_name("N")
            ->check(CLI::Range(1, 10000))
            ->needs(parser.get_option("--histogram"));
    }

    InspectRequest asks_;
    bool gl_given_ = false, windowed_ = false;
};

}  // namespace

std::unique_ptr<Verb> inspect_verb() {
    return std::make_unique<Inspect>();
}

}  // namespace grainreel
