// The verb `inspect`: questions to a moment of a run.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/inspect/grain_columns.hpp"
#include "engine/inspect/questions.hpp"
#include "render/cli/inspect/print_answer.hpp"
#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/verbs/verb.hpp"
#include "render/run/frames/recorded_run.hpp"
#include "render/run/pick/pixel_question.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::string about_columns() {
    std::string text =
        "Quantities of a grain, for --where and --histogram (where units may be written, as in 2 cm):\n";
    for (const GrainColumn& column : grain_columns())
        text += fmt::format("  {:<15}{}{}\n", column.name, column.about,
                            column.needs_contacts ? " (where the run kept contacts)" : "");
    return text;
}

class Inspect final : public Verb {
  public:
    Inspect()
        : Verb("inspect", "Ask a moment of a run: who is this grain, where are the big ones",
               "Without a question: the moment on one screen.\n\n" + about_columns() +
                   "\nExample:  grainreel inspect output/gravel --at 1.2s --where \"species == big and "
                   "height > 2 "
                   "cm\"\n\nExit status: 0 done, 2 a mistake in the options, or a run that cannot be read.") {
    }

    void add_options(CLI::App& parser) override {
        parser.add_option("RUN", run_, "Folder of a run, with its scene.toml and trajectory.nc")
            ->required()
            ->type_name("DIR");
        CLI::Option* at =
            add_time(parser, "--at", at_, "Moment: the kept one that is nearest [the run's last]");
        CLI::Option* cycle = parser.add_option("--cycle", cycle_, "Moment in periods of the drive, as in 40");
        cycle->type_name("N")->excludes(at);
        parser.add_option("--phase", phase_, "With --cycle: so far into the period, from 0 to 1 [0]")
            ->type_name("TURN")
            ->needs(cycle)
            ->check(CLI::Range(0.0, 1.0));
        add_questions(parser);
        add_sets(parser, sets_,
                 "With --pixel: another value for a key of [film], as for render; may be repeated");
        add_picture_keys(parser, sets_);
        parser.add_option("--limit", limit_, "Longest list of grains [10]")
            ->type_name("N")
            ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
        CLI::Option* json = parser.add_flag("--json", json_, "Answer as JSON, in SI units");
        parser.add_flag("--csv", csv_, "Answer as CSV, in SI units")->excludes(json);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        const RecordedRun record(run_, sets_for_contacts());
        for (const std::string& line : record.news()) reporter.detail(line);
        const std::size_t index = moment_of(record);
        const Snapshot snapshot = snapshot_at(record, index);
        if (!json_ && !csv_)
            reporter.info(fmt::format("{}: {:.6g} s, kept moment {} of {}", record.folder().string(),
                                      snapshot.frame.time, index + 1, record.moments().size()));
        const Answer answer = answer_of(record, snapshot);
        print_result(json_ ? json_of(answer) : csv_ ? csv_of(answer) : text_of(answer));
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    void add_questions(CLI::App& parser) {
        std::vector<CLI::Option*> questions = {
            parser.add_option("--grain", grain_, "This grain: place, velocity, contacts")->type_name("ID"),
            parser.add_option("--where", where_, "Grains for which this holds: count, statistics, list")
                ->type_name("CONDITION"),
            parser.add_option("--profile", profile_, "By bins along height, x, y, z, or r from the axis")
                ->type_name("DIRECTION"),
            parser.add_option("--histogram", histogram_, "How many grains have which value")
                ->type_name("QUANTITY"),
            parser.add_flag("--pair-distribution", pairs_, "Radial distribution function of the centres"),
            add_time(parser, "--compare", compare_, "Who moved most between then and the moment"),
            parser
                .add_option("--pixel", pixel_, "Which grain or wall is at this pixel of the film's picture")
                ->type_name("X,Y")
                ->delimiter(',')
                ->expected(2)};
        for (std::size_t i = 0; i < questions.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) questions[i]->excludes(questions[k]);
        parser.add_flag("--through", through_, "With --pixel: what lies behind it, too")
            ->needs(questions.back());
        parser
            .add_option("--film-time", film_time_, "With --pixel: where a camera that moves is then, s [0]")
            ->type_name("TIME")
            ->needs(questions.back());
        parser.add_option("--bins", bins_, "With --histogram: how many [20]")
            ->type_name("N")
            ->check(CLI::Range(1, 10000));
    }

    // With what has contacts read, when the run kept them.
    Assignments sets_for_contacts() const {
        std::error_code ignored;
        Assignments sets = sets_;
        if (fs::exists(run_ / "contacts.nc", ignored))
            sets.push_back({"film.force_chains=true", "contacts.nc"});
        return sets;
    }

    // The kept moment that is asked for.
    std::size_t moment_of(const RecordedRun& record) const {
        if (at_) return near_kept(record, *at_, "--at");
        if (!cycle_) return record.moments().size() - 1;
        if (!record.scene().drive.present) throw UserError("--cycle: the run has no drive; give --at TIME");
        const Clock& clock = record.clock();
        return near_kept(record, clock.time(clock.step_at(*cycle_ + phase_)), "--cycle");
    }

    static std::size_t near_kept(const RecordedRun& record, double time, const char* option) {
        const Span span = record.span();
        const double hair = 1e-9 + 1e-9 * std::abs(time);
        if (!(time >= span.from - hair && time <= span.to + hair))
            throw UserError(fmt::format("{}: {:.6g} s is outside the run, which kept {:.6g} to {:.6g} s",
                                        option, time, span.from, span.to));
        return record.nearest(time);
    }

    static Snapshot snapshot_at(const RecordedRun& record, std::size_t index) {
        return {record.scene(), record.frame(index), record.supply().contacts, record.first_whole()};
    }

    Answer answer_of(const RecordedRun& record, const Snapshot& snapshot) const {
        if (grain_) return named("--grain", [&] { return grain_answer(snapshot, *grain_); });
        if (where_) return named("--where", [&] { return where_answer(snapshot, *where_, limit_); });
        if (profile_) return named("--profile", [&] { return profile_answer(snapshot, *profile_); });
        if (histogram_)
            return named("--histogram", [&] {
                return histogram_answer(snapshot, *histogram_, static_cast<std::size_t>(bins_));
            });
        if (!pixel_.empty())
            return named("--pixel", [&] {
                return pixel_answer(snapshot, {pixel_[0], pixel_[1], through_, film_time_});
            });
        if (pairs_) return named("--pair-distribution", [&] { return pair_distribution_answer(snapshot); });
        if (compare_) {
            const Snapshot before = snapshot_at(record, near_kept(record, *compare_, "--compare"));
            return named("--compare", [&] { return compare_answer(before, snapshot, limit_); });
        }
        return overview_of(snapshot);
    }

    // A mistake in a question gets the option's name.
    template <class Ask>
    static Answer named(const char* option, const Ask& ask) {
        try {
            return ask();
        } catch (const UserError& mistake) {
            throw UserError(fmt::format("{}: {}", option, mistake.what()));
        }
    }

    fs::path run_;
    Assignments sets_;
    std::vector<double> pixel_;
    bool through_ = false;
    double film_time_ = 0;
    std::optional<double> at_, cycle_, compare_;
    double phase_ = 0;
    std::optional<std::int64_t> grain_;
    std::optional<std::string> where_, profile_, histogram_;
    bool pairs_ = false, json_ = false, csv_ = false;
    int bins_ = 20;
    std::size_t limit_ = 10;
};

}  // namespace

std::unique_ptr<Verb> inspect_verb() {
    return std::make_unique<Inspect>();
}

}  // namespace grainreel
