// The verb `inspect`: questions to a moment of a run.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frame_faults.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/answer_forces.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/questions/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/questions/steadiness.hpp"
#include "engine/questions/where_question.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/app/inspect/print_answer.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/answers/filmed_record.hpp"
#include "render/film/answers/pictured_answer.hpp"
#include "render/film/sampling/film_frames.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::string about_columns() {
    std::string text =
        "Quantities of a grain, for --where and --histogram (numbers have units there, as in 2 cm). * brings "
        "the "
        "moment\nback, which may take a while:\n";
    for (const GrainColumn& column : grain_columns())
        text += fmt::format("  {:<20}{}{}{}\n", column.name, column.needs == Needs::nothing ? "  " : "* ",
                            column.about,
                            column.also.empty() ? "" : fmt::format("; also called {}", column.also));
    return text +
           "Conditions are joined by and, or, not. touches(WHO) holds where a grain has a contact that "
           "carries "
           "force\nwith any wall (touches(wall)), a wall, a species or the grain of an id.\n";
}

class Inspect final : public Verb {
  public:
    Inspect()
        : Verb(
              "inspect", "Ask a moment of a run: who is this grain, where are the big ones",
              "Without a question: the moment on one screen: the species, which grain stands out and which "
              "is "
              "the tip of\nthe bed, what pushes on which wall, and what the run measured, segregation among "
              "it. A moment that the\nrun did not keep is brought back from its checkpoints, and so are the "
              "forces.\n\n" +
                  about_columns() +
                  "\nExamples:\n"
                  "  grainreel inspect output/gravel --at 1.2s\n"
                  "  grainreel inspect output/gravel --at 1.2s --where \"species == big and height > 2 cm\"\n"
                  "  grainreel inspect output/gravel --at 1.2s --wall \"left slant\"\n"
                  "  grainreel inspect output/gravel --at 1.2s --grain 12 --png grain.png\n"
                  "\nExit status: 0 done, 2 a mistake in the options, or a run that cannot be read.") {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("RUN", run_,
                        "Folder of a run, with its scene.toml and trajectory.nc; or a checkpoint, a "
                        "final.csv or a trajectory.nc alone; or files of another program")
            ->required()
            ->type_name("PATH");
        parser.option_defaults()->group("Moment");
        CLI::Option* at = add_time(parser, "--at", moment_.at, "Moment [the run's last]");
        parser.add_option("--frame", moment_.frame, "Moment of this frame of the film, counted from 0")
            ->type_name("N")
            ->excludes(at);
        CLI::Option* cycle =
            parser.add_option("--cycle", moment_.cycle, "Moment in periods of the drive, as in 40");
        cycle->type_name("N")->excludes(at)->excludes(parser.get_option("--frame"));
        parser.add_option("--phase", phase_, "With --cycle: so far into the period, from 0 to 1 [0]")
            ->type_name("TURN")
            ->needs(cycle)
            ->check(CLI::Range(0.0, 1.0));
        CLI::Option* average =
            parser
                .add_option("--average", average_,
                            "Mean over this many periods up to the moment; of the largest overlaps, those of "
                            "all these moments")
                ->type_name("N")
                ->check(CLI::Range(0.05, 1e6));
        parser.add_flag("--no-replay", no_replay_,
                        "Give what was kept alone: the kept moment that is nearest");
        add_reading(parser, reading_);
        parser.option_defaults()->group("Question (one of them; none: an overview)");
        add_questions(parser);
        parser.option_defaults()->group("Picture");
        add_time(parser, "--film-time", film_time_,
                 "With --pixel or --png: where a camera that moves is then [that of --frame, else 0]");
        parser
            .add_option("--png", picture_,
                        "Draw the moment too, with the answer ringed and all else pale; with --grain and "
                        "--wall the forces on it as arrows")
            ->type_name("FILE")
            ->check(not_empty())
            ->excludes(average);
        add_gl(parser, gl_);
        add_sets(parser, sets_,
                 "With --pixel or --png: another value for a key of [film], as for render; may be repeated");
        add_picture_keys(parser, sets_);
        parser.option_defaults()->group("Answer");
        parser.add_option("--limit", limit_, "Longest list of grains [10]")
            ->type_name("N")
            ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
        CLI::Option* json = parser.add_flag("--json", json_, "Answer as JSON, in SI units");
        parser.add_flag("--csv", csv_, "Answer as CSV, in SI units")->excludes(json);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        if (!picture_.empty()) check_picture_file(picture_);
        check_options();
        open(reporter);
        const Record* const record = asked_->record;
        tell_news(*record, reporter);
        MomentFinder finder(*record);
        Answer answer = steady_ ? named("--steady", [&] { return steady(*record); })
                        : series()
                            ? named("--where", [&] { return series_answer(finder, *record, reporter); })
                        : average_ ? mean_answer(finder, *record, reporter)
                                   : single_answer(finder, *record, reporter);
        answer.notes.insert(answer.notes.end(), missing_.begin(), missing_.end());
        print_result(json_ ? json_of(answer) : csv_ ? csv_of(answer) : text_of(answer));
        if (csv_) tell_beside(answer, reporter);
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    bool series() const { return over_time_ || every_.has_value(); }
    bool draws() const { return !picture_.empty() || !pixel_.empty(); }

    // What would be accepted and do nothing.
    void check_options() const {
        if (average_ && compare_)
            throw UserError(
                "--average: --compare is between two moments, of which there is no mean; leave one out");
        if (over_time_ && !picture_.empty())
            throw UserError("--over-time: --png is of one moment; leave one out");
        if (over_time_ && (moment_.at || moment_.frame || moment_.cycle))
            throw UserError("--over-time: is of all kept moments; leave the moment out");
        if (every_ && (!picture_.empty() || moment_.at || moment_.frame || moment_.cycle))
            throw UserError("--every: is of the whole run; leave moment and picture out");
        if (every_ && !(*every_ > 0)) throw UserError("--every: must be longer than 0 s");
        if (!mean_.empty() && !series()) throw UserError("--mean: is over time; add --every or --over-time");
        if (steady_ && (!picture_.empty() || average_ || moment_.at || moment_.frame || moment_.cycle))
            throw UserError("--steady: is of the whole run; leave moment, mean and picture out");
        if (average_ && !pixel_.empty())
            throw UserError("--average: --pixel is of one picture, so there is no mean; leave one out");
        if (film_time_ && !draws())
            throw UserError("--film-time: says what a picture shows; add --png or --pixel");
        for (const Assignment& set : sets_)
            if (!draws() && set.key() != "run.threads")
                throw UserError(
                    fmt::format("{}: says how a picture is drawn; add --png or --pixel", set.place()));
    }

    // A table has no room for words.
    static void tell_beside(const Answer& answer, Reporter& reporter) {
        if (const std::string line = moment_line(answer); !line.empty()) reporter.info(line);
        for (const std::string& note : answer.notes) reporter.info(note);
    }

    void add_questions(CLI::App& parser) {
        std::vector<CLI::Option*> questions = {
            parser
                .add_option("--grain", grain_,
                            "This grain: place, velocity, contacts, what pushes it, neighbours")
                ->type_name("ID"),
            parser
                .add_option(
                    "--wall", wall_,
                    "This wall or mesh, as in floor, \"left slant\" or drum (the overview lists them): "
                    "force and moment on it, "
                    "pressure by height, who touches it, how many of each species")
                ->type_name("NAME"),
            parser.add_flag("--largest-overlap", largest_overlap_, "The contacts that overlap most"),
            parser.add_option("--where", where_, "Grains for which this holds: count, statistics, list")
                ->type_name("CONDITION"),
            parser.add_option("--profile", profile_, "By bins along height, x, y, z, or r from the axis")
                ->type_name("DIRECTION"),
            parser.add_option("--slice", slice_, "Grains that this plane cuts, as in y=0 or \"z = 2 cm\"")
                ->type_name("PLANE"),
            parser.add_option("--histogram", histogram_, "How many grains have which value")
                ->type_name("QUANTITY"),
            parser.add_flag("--pair-distribution", pairs_, "Radial distribution function of the centres"),
            add_time(parser, "--compare", compare_, "Who moved most between then and the moment"),
            parser
                .add_option("--steady", steady_,
                            "Whether this column of measures.csv is steady: where its transient ends, and "
                            "whether it drifts behind that")
                ->type_name("COLUMN"),
            parser
                .add_option("--pixel", pixel_, "Which grain or wall is at this pixel of the film's picture")
                ->type_name("X,Y")
                ->delimiter(',')
                ->expected(2)};
        for (std::size_t i = 0; i < questions.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) questions[i]->excludes(questions[k]);
        parser
            .add_flag("--over-time", over_time_,
                      "With --where: how many of each species at every moment that was kept")
            ->needs(parser.get_option("--where"))
            ->excludes(parser.get_option("--average"));
        add_time(parser, "--every", every_,
                 "With --where: the same at each multiple of this time, brought back")
            ->needs(parser.get_option("--where"))
            ->excludes(parser.get_option("--average"))
            ->excludes(parser.get_option("--over-time"));
        parser
            .add_option("--mean", mean_,
                        "With --every or --over-time: the mean of this quantity over these grains, too")
            ->type_name("QUANTITY")
            ->needs(parser.get_option("--where"));
        parser.add_flag("--through", through_, "With --pixel: what lies behind it, too")
            ->needs(questions.back());
        parser.add_option("--bins", bins_, "With --histogram: how many [20]")
            ->type_name("N")
            ->check(CLI::Range(1, 10000))
            ->needs(parser.get_option("--histogram"));
    }

    Answer steady(const Record& record) const {
        const fs::path& place = record.frames().path();
        return steady_answer(place, record.scene(), *steady_);
    }

    Answer series_answer(MomentFinder& finder, const Record& record, Reporter& reporter) const {
        if (every_ && takes_in_series(Needs::period))
            throw UserError("ways over a period are known of single moments; leave --every out");
        SeriesRequest request{*where_, mean_, every_, !no_replay_ && !foreign_};
        return series_of(finder, record, request, watcher_of(reporter));
    }

    bool takes_in_series(Needs what) const {
        const std::vector<Needs> all = needs_of(*where_ + " " + mean_);
        return std::find(all.begin(), all.end(), what) != all.end();
    }

    Answer single_answer(MomentFinder& finder, const Record& record, Reporter& reporter) {
        const ChosenMoment chosen = snapshot_of(finder, record, reporter);
        const Snapshot& snapshot = chosen.snapshot;
        Answer answer = answer_of(finder, snapshot, reporter);
        answer.moment = chosen.about;
        if (!picture_.empty())
            draw_answer(snapshot, asked_->scene(), marks_of(snapshot, answer), film_time(), picture_, gl_);
        return answer;
    }

    // A question about forces gets arrows.
    AnswerMarks marks_of(const Snapshot& snapshot, const Answer& answer) const {
        if (!grain_ && !wall_) {
            const std::string count =
                answer.grains ? fmt::format("{} of {} grains", answer.grains->size(), snapshot.frame.size())
                              : "";
            return {grains_in(answer), {}, count, true};
        }
        const AnswerForces all =
            grain_ ? forces_on_grain(snapshot, *grain_) : forces_on_wall(snapshot, *wall_);
        return {all.grains, all.forces, all.words, !snapshot.forces};
    }

    void open(Reporter& reporter) {
        std::error_code ignored;
        const bool foreign = is_foreign(run_);
        if (const std::string option = given_reading(reading_); !foreign && !option.empty())
            throw UserError(
                fmt::format("{}: is for files of other programs, and {} is a run of ours or is not there",
                            option, run_.string()));
        // Frames are counted in the file that was named, so it is read without its series.
        reading_.one = true;
        if (foreign && draws()) return open_import(reporter);
        asked_ = foreign || fs::is_regular_file(run_, ignored)
                     ? open_filmed_state(run_, sets_, reading_)
                     : open_filmed_run(run_, sets_for_contacts(run_));
        // A trajectory of ours alone is no file of another program here.
        foreign_ = dynamic_cast<const ForeignArchive*>(&asked_->record->frames()) != nullptr;
        no_replay_ = no_replay_ || foreign_;
        CaptionHolds holds(asked_->scene().film);
        moment_.held = [holds](double time) mutable { return holds.begin_at(time); };
    }

    // Pictures of another program's files are those of render, so they are of the import.
    void open_import(Reporter& reporter) {
        const RunToRead read = run_to_read(run_, reading_, reporter);
        asked_ = open_filmed_run(read.folder, sets_for_contacts(read.folder));
        foreign_ = no_replay_ = moment_.frame_of_file = true;
    }

    // What is damaged or not of this run is left out of answers, and the user is to know.
    void tell_news(const Record& record, Reporter& reporter) {
        const std::vector<std::string> faults = record.faults();
        for (const std::string& line : record.news()) {
            if (std::find(faults.begin(), faults.end(), line) == faults.end()) reporter.detail(line);
            if (!fs::is_directory(run_)) missing_.push_back(line);
        }
        for (const auto& lines : {faults, record.checkpoint_news()})
            for (const std::string& line : lines) reporter.warning(line);
    }

    // With what has contacts read, when the run kept them.
    Assignments sets_for_contacts(const fs::path& folder) const {
        std::error_code ignored;
        Assignments sets = sets_;
        if (fs::exists(folder / "contacts.nc", ignored))
            sets.push_back({"film.force_chains=true", "contacts.nc"});
        return sets;
    }

    // Whether the question is about what only the engine knows.
    bool asks_for_forces() const { return wall_ || largest_overlap_; }

    // s of the film; a camera that moves is somewhere else at each.
    double film_time() const {
        if (film_time_) return *film_time_;
        return moment_.frame ? static_cast<double>(*moment_.frame) / asked_->scene().film.rate : 0;
    }

    bool asks_nothing() const {
        return !where_ && !profile_ && !slice_ && !histogram_ && pixel_.empty() && !pairs_ && !compare_;
    }

    // Whether a condition or a histogram takes that.
    bool takes(Needs what) const {
        const std::vector<Needs> all = needs_of(where_.value_or("") + " " + histogram_.value_or(""));
        return std::find(all.begin(), all.end(), what) != all.end();
    }

    // Whether a kept moment lacks what is asked for.
    bool is_to_be_brought_back(const MomentFinder& finder, const AskedMoment& asked,
                               const Record& record) const {
        if (!asked.kept || asks_for_forces()) return true;
        if (grain_) return finder.can_bring_back(asked);
        return (takes(Needs::contacts) && !record.frames().has_contacts_of(*asked.kept)) ||
               takes(Needs::forces) || takes(Needs::period) ||
               (asks_nothing() && finder.is_checkpoint(asked));
    }

    // A kept moment. None where it is damaged and can be brought back.
    std::optional<Snapshot> kept_moment(const MomentFinder& finder, const AskedMoment& asked,
                                        Reporter& reporter) const {
        try {
            return finder.kept(asked.nearest);
        } catch (const DamagedFrame& damage) {
            if (no_replay_ || !asked.kept || !finder.can_bring_back(asked)) throw;
            reporter.warning(fmt::format("{}; the moment is brought back", damage.what()));
            return std::nullopt;
        }
    }

    struct ChosenMoment {
        Snapshot snapshot;
        AnswerMoment about;
    };

    ChosenMoment snapshot_of(MomentFinder& finder, const Record& record, Reporter& reporter) {
        if (moment_.cycle) *moment_.cycle += phase_;
        const AskedMoment asked = finder.find(moment_);
        const char* last = asked.last ? "the run's last moment, " : "";
        if (foreign_) check_known(asked, record);
        if (no_replay_ && asks_for_forces())
            throw UserError(
                "--no-replay: forces on walls and overlaps are not kept, they are brought back; leave it "
                "out");
        const bool as_kept = no_replay_ || !is_to_be_brought_back(finder, asked, record);
        if (auto kept = as_kept ? kept_moment(finder, asked, reporter) : std::nullopt) {
            if (!asked.kept)
                missing_.push_back(
                    fmt::format("{:.6g} s was not kept; this is the nearest kept moment", asked.time));
            const Frame& moment = record.moments()[asked.nearest];
            return {std::move(*kept),
                    {moment.time, moment.step,
                     fmt::format("{}kept as number {} of {}", asked.kept ? last : "", asked.nearest + 1,
                                 record.moments().size())}};
        }
        Snapshot snapshot = takes(Needs::period) ? finder.brought_back_with_ways(asked, watcher_of(reporter))
                                                 : finder.brought_back(asked, watcher_of(reporter));
        const Frame& frame = snapshot.frame;
        AnswerMoment about{frame.time, frame.step, fmt::format("{}brought back", last)};
        return {std::move(snapshot), std::move(about)};
    }

    // Nothing of another program's run can be brought back.
    void check_known(const AskedMoment& asked, const Record& record) const {
        if (asks_for_forces())
            throw UserError(
                fmt::format("{}: {}: forces on walls and overlaps are known of runs of ours alone",
                            wall_ ? "--wall" : "--largest-overlap", run_.string()));
        if (takes(Needs::contacts) && !record.frames().has_contacts_of(asked.nearest))
            throw UserError(
                fmt::format("{}: says no contacts of that moment; name a file that has them by --contacts",
                            run_.string()));
        if (takes(Needs::forces) || takes(Needs::period))
            throw UserError(
                fmt::format("{}: a quantity that is asked for is known of runs of ours alone; "
                            "--help lists the others, without a *",
                            run_.string()));
    }

    static ReplayWatcher watcher_of(Reporter& reporter) {
        return replay_progress([&reporter](const Progress& progress) { reporter.progress(progress); });
    }

    // Over periods up to the moment.
    Answer mean_answer(MomentFinder& finder, const Record& record, Reporter& reporter) const {
        const AskedMoment asked = finder.find(moment_);
        const bool replay = !no_replay_ && finder.can_bring_back(asked);
        if (!replay && asks_for_forces())
            throw UserError(
                "--average: forces on walls and overlaps are not kept, and nothing is brought back here; "
                "leave "
                "--no-replay out, or run the scene again with output.checkpoints");
        MeanAnswer mean(limit_);
        std::optional<Histogram> histogram;
        if (histogram_) histogram.emplace(*histogram_);
        std::size_t moments = 0, without_grain = 0;
        double bin = 0;
        finder.over_periods(asked, *average_, replay, watcher_of(reporter), [&](Snapshot snapshot) {
            ++moments;
            // Grains come and go; bins of all moments are the same.
            if (bin == 0 && snapshot.frame.size() > 0) bin = snapshot.bin();
            snapshot.bin_width = bin;
            if (grain_ && !snapshot.place_of(*grain_))
                ++without_grain;
            else if (histogram)
                named("--histogram", [&] { return histogram->add(snapshot); });
            else
                mean.add(answer_of(finder, snapshot, reporter), snapshot.frame.time);
        });
        if (moments == 0)
            throw UserError(fmt::format("--average: {} kept no moment in the {} periods before {:.6g} s",
                                        record.frames().path().string(), *average_, asked.time));
        if (without_grain == moments)
            throw UserError(
                fmt::format("--grain: no grain has the id {} at any of the {} moments", *grain_, moments));
        Answer answer = histogram ? named("--histogram",
                                          [&] { return histogram->answer(static_cast<std::size_t>(bins_)); })
                                  : mean.mean();
        if (without_grain > 0)
            answer.notes.push_back(
                fmt::format("the grain is not there at {} of the {} moments", without_grain, moments));
        answer.moment = {asked.time, asked.step,
                         fmt::format("mean over {} moments of the {} periods before", moments, *average_)};
        return answer;
    }

    Answer answer_of(MomentFinder& finder, const Snapshot& snapshot, Reporter& reporter) const {
        if (wall_) return named("--wall", [&] { return wall_answer(snapshot, *wall_, limit_); });
        if (largest_overlap_) return largest_overlap_answer(snapshot, limit_);
        if (grain_) return named("--grain", [&] { return grain_answer(snapshot, *grain_); });
        if (where_) return named("--where", [&] { return where_answer(snapshot, *where_, limit_); });
        if (profile_) return named("--profile", [&] { return profile_answer(snapshot, *profile_); });
        if (slice_) return named("--slice", [&] { return slice_answer(snapshot, *slice_, limit_); });
        if (histogram_)
            return named("--histogram", [&] {
                return histogram_answer(snapshot, *histogram_, static_cast<std::size_t>(bins_));
            });
        if (!pixel_.empty())
            return named("--pixel", [&] {
                Answer there =
                    PixelPicker(snapshot, asked_->scene(), film_time()).at(pixel_[0], pixel_[1], through_);
                if (there.tables[0].rows.empty())
                    throw UserError(fmt::format("nothing is at {:g},{:g}", pixel_[0], pixel_[1]));
                return there;
            });
        if (pairs_) return named("--pair-distribution", [&] { return pair_distribution_answer(snapshot); });
        if (compare_) {
            const AskedMoment earlier = finder.find({.at = compare_, .at_option = "--compare"});
            const bool replay = !earlier.kept && !no_replay_;
            const Snapshot before =
                replay ? finder.brought_back(earlier, watcher_of(reporter)) : finder.kept(earlier.nearest);
            return named("--compare", [&] { return compare_answer(before, snapshot, limit_); });
        }
        return overview_of(snapshot);
    }

    // A mistake in a question gets the option's name.
    template <class Ask>
    static auto named(const char* option, const Ask& ask) -> decltype(ask()) {
        try {
            return ask();
        } catch (const UserError& mistake) {
            throw UserError(fmt::format("{}: {}", option, mistake.what()));
        }
    }

    ReadingOptions reading_;
    fs::path run_;
    Assignments sets_;
    std::unique_ptr<const FilmedRecord> asked_;  // once it is open
    fs::path picture_;
    gl::Provider gl_ = gl::Provider::automatic;
    std::vector<double> pixel_;
    bool through_ = false;
    std::optional<double> film_time_;
    MomentRequest moment_;
    std::optional<double> compare_, average_, every_;
    std::optional<std::string> steady_;
    std::string mean_;
    double phase_ = 0;
    std::optional<std::int64_t> grain_;
    std::optional<std::string> wall_, where_, profile_, slice_, histogram_;
    bool pairs_ = false, largest_overlap_ = false, no_replay_ = false, json_ = false, csv_ = false,
         over_time_ = false, foreign_ = false;
    std::vector<std::string> missing_;  // what an answer lacks
    int bins_ = 20;
    std::size_t limit_ = 10;
};

}  // namespace

std::unique_ptr<Verb> inspect_verb() {
    return std::make_unique<Inspect>();
}

}  // namespace grainreel
