#include "render/app/inspect/inspection.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/contact_questions.hpp"
#include "engine/questions/discharge.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/field_means.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/run_parameters.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/questions/steadiness.hpp"
#include "engine/questions/where_question.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/film/answers/pictured_answer.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

class Inspection {
  public:
    explicit Inspection(const InspectRequest& request) : asks_(request) {}

    Answer answer(Reporter& reporter) {
        open(reporter);
        StoredRun& run = *asked_.run;
        tell_news(run, reporter);
        Answer answer =
            asks_.steady       ? named("--steady", [&] { return steady_answer(run, *asks_.steady); })
            : asks_.discharge  ? named("--discharge", [&] { return discharge_answer(run); })
            : asks_.parameters ? named("--parameters", [&] { return parameters_answer(run); })
            : !asks_.fields.empty()
                ? named("--fields", [&] { return fields_answer(run, asks_.fields, asks_.columns.window); })
            : asks_.of_columns() ? named("--measure", [&] { return columns_answer(run, asks_.columns); })
            : asks_.series()     ? named("--where", [&] { return series_answer(run, reporter); })
            : asks_.average      ? mean_answer(run, reporter)
                                 : single_answer(run, reporter);
        answer.notes.insert(answer.notes.end(), missing_.begin(), missing_.end());
        return answer;
    }

  private:
    Answer series_answer(StoredRun& run, Reporter& reporter) const {
        if (asks_.every && takes_in_series(Needs::period))
            throw UserError("ways over a period are known of single moments; leave --every out");
        SeriesRequest request{*asks_.where, asks_.mean, asks_.every, !asks_.no_replay && !foreign_};
        return series_of(run, request, watcher_of(reporter));
    }

    bool takes_in_series(Needs what) const {
        const std::vector<Needs> all = needs_of(*asks_.where + " " + asks_.mean);
        return contains(all, what);
    }

    Answer single_answer(StoredRun& run, Reporter& reporter) {
        const ChosenMoment chosen = snapshot_of(run, reporter);
        const Snapshot& snapshot = chosen.snapshot;
        Answer answer = answer_of(run, snapshot, reporter);
        answer.moment = chosen.about;
        if (!asks_.picture.empty())
            draw_answer(snapshot, asked_.scene, marks_of(snapshot, answer), film_time(), asks_.picture,
                        asks_.gl);
        return answer;
    }

    // What the picture of an answer marks: the forces on the grain or wall that is asked for, else the
    // answer's grains.
    AnswerMarks marks_of(const Snapshot& snapshot, const Answer& answer) const {
        if (!asks_.grain && !asks_.wall) {
            const std::string count =
                answer.grains ? fmt::format("{} of {} grains", answer.grains->size(), snapshot.frame.size())
                              : "";
            return {grains_in(answer), {}, count, true};
        }
        const AnswerForces all =
            asks_.grain ? forces_on_grain(snapshot, *asks_.grain) : forces_on_wall(snapshot, *asks_.wall);
        return {all.grains, all.forces, all.words, !snapshot.forces};
    }

    void open(Reporter& reporter) {
        const bool foreign = is_foreign(asks_.run);
        check_reading(asks_.run, asks_.reading);
        if (!foreign) refuse_other_folder(asks_.run);
        bring_back_to_read(asks_.run, reporter);
        // A number of a frame counts the frames of the named file, so the other files of its series are left
        // out.
        asks_.reading.one = true;
        if (foreign && asks_.draws()) return open_import(reporter);
        if (!foreign && !is_plain(asks_.run)) folder_of_run(asks_.run);
        open_run(asks_.run);
        // Our own trajectory without its folder does not count as a file of another program here.
        foreign_ = asked_.run->kind() == StoredRun::Kind::foreign;
        elsewhere_ = asked_.run->kind() == StoredRun::Kind::elsewhere;
        foreign_ = foreign_ || elsewhere_;
        asks_.no_replay = asks_.no_replay || foreign_;
        CaptionHolds holds(asked_.scene.film);
        asks_.moment.held = [holds](double time) mutable { return holds.begin_at(time); };
    }

    // Opens an import of another program's files, as `render` does, so that pictures are the same.
    void open_import(Reporter& reporter) {
        const RunToRead read = run_to_read(asks_.run, asks_.reading, reporter);
        open_run(read.folder);
        foreign_ = asks_.no_replay = asks_.moment.frame_of_file = true;
    }

    void open_run(const fs::path& path) {
        StoredRunRequest request;
        request.reading = asks_.reading;
        request.threads = 0;
        asked_ = open_filmed(path, asks_.sets, request);
    }

    // Tells the user which files are left out of answers because they are damaged or of another run.
    void tell_news(const StoredRun& run, Reporter& reporter) {
        const std::vector<std::string> faults = run.faults();
        for (const std::string& line : run.news()) {
            if (!contains(faults, line)) reporter.detail(line);
            if (!fs::is_directory(asks_.run)) missing_.push_back(line);
        }
        for (const auto& lines : {faults, run.checkpoint_news()})
            for (const std::string& line : lines) reporter.warning(line);
    }

    // Whether the question is about forces on walls or overlaps. Runs do not keep them; only the engine can
    // compute them.
    bool asks_for_forces() const { return asks_.wall || asks_.largest_overlap; }

    // Time in the film in s. The place of a moving camera depends on it.
    double film_time() const {
        if (asks_.film_time) return *asks_.film_time;
        return asks_.moment.frame ? static_cast<double>(*asks_.moment.frame) / asked_.scene.film.rate : 0;
    }

    bool asks_nothing() const {
        return !asks_.where && !asks_.profile && !asks_.slice && !asks_.histogram && asks_.pixel.empty() &&
               !asks_.pairs && !asks_.compare;
    }

    // Whether a condition or a histogram needs `what`.
    bool takes(Needs what) const {
        const std::vector<Needs> all =
            needs_of(asks_.where.value_or("") + " " + asks_.histogram.value_or(""));
        return contains(all, what);
    }

    // Whether the moment must be simulated again: the run did not keep it, or kept it without what is asked
    // for.
    bool is_to_be_brought_back(const AskedMoment& asked, const StoredRun& run) const {
        if (!asked.kept || asks_for_forces()) return true;
        if (asks_.grain) return run.brings_back(asked.step);
        return (takes(Needs::contacts) && !run.has_contacts_of(*asked.kept)) || takes(Needs::forces) ||
               takes(Needs::period) || (asks_nothing() && has_checkpoint(run, asked));
    }

    // Reads a kept moment. None when it is damaged but can be brought back.
    std::optional<Snapshot> kept_moment(const StoredRun& run, const AskedMoment& asked,
                                        Reporter& reporter) const {
        try {
            Snapshot snapshot = kept_snapshot(run, asked.nearest, takes(Needs::period));
            const double time = snapshot.frame.time;
            if (asks_.draws() && shows_wear(asked_.scene)) snapshot.worn = run.worn(time);
            if (asks_.draws() && asked_.scene.film.shows.outflow) snapshot.flowed_out = run.flowed_out(time);
            return snapshot;
        } catch (const DamagedFrame& damage) {
            if (asks_.no_replay || !asked.kept || !run.brings_back(asked.step)) throw;
            reporter.warning(fmt::format("{}; the moment is brought back", damage.what()));
            return std::nullopt;
        }
    }

    struct ChosenMoment {
        Snapshot snapshot;
        AnswerMoment about;
    };

    ChosenMoment snapshot_of(StoredRun& run, Reporter& reporter) {
        if (asks_.moment.cycle) *asks_.moment.cycle += asks_.phase;
        const AskedMoment asked = find_moment(run, asks_.moment);
        const char* last = asked.last ? "the run's last moment, " : "";
        if (foreign_) check_known(asked, run);
        if (asks_.no_replay && asks_for_forces())
            throw UserError(
                "--no-replay: forces on walls and overlaps are not kept, they are brought back; leave it "
                "out");
        const bool as_kept = asks_.no_replay || !is_to_be_brought_back(asked, run);
        if (auto kept = as_kept ? kept_moment(run, asked, reporter) : std::nullopt) {
            if (!asked.kept)
                missing_.push_back(
                    fmt::format("{:.6g} s was not kept; this is the nearest kept moment", asked.time));
            const State& moment = run.moments()[asked.nearest];
            return {std::move(*kept),
                    {moment.time, run.written_step(asked.nearest),
                     fmt::format("{}kept as number {} of {}", asked.kept ? last : "", asked.nearest + 1,
                                 run.moments().size())}};
        }
        Snapshot snapshot = takes(Needs::period) ? brought_back_with_ways(run, asked, watcher_of(reporter))
                                                 : brought_back_snapshot(run, asked, watcher_of(reporter));
        const State& frame = snapshot.frame;
        AnswerMoment about{frame.time, frame.step, fmt::format("{}brought back", last)};
        return {std::move(snapshot), std::move(about)};
    }

    // Throws when the question needs something that the files of another program lack. Their runs cannot be
    // simulated again.
    void check_known(const AskedMoment& asked, const StoredRun& run) const {
        if (asks_for_forces())
            throw UserError("{}: {}: forces on walls and overlaps are known of runs of our own engine alone",
                            asks_.wall ? "--wall" : "--largest-overlap", asks_.run.string());
        if (elsewhere_ && takes(Needs::contacts))
            throw UserError(
                "{}: another engine computed the run, and its dumps have no contacts; --help lists "
                "the quantities that are always known, without a *",
                asks_.run.string());
        if (takes(Needs::contacts) && !run.has_contacts_of(asked.nearest))
            throw UserError("{}: says no contacts of that moment; name a file that has them by --contacts",
                            asks_.run.string());
        if (takes(Needs::forces) || takes(Needs::period))
            throw UserError(
                "{}: a quantity that is asked for is known of runs of our own engine alone; "
                "--help lists the others, without a *",
                asks_.run.string());
    }

    static ReplayWatcher watcher_of(Reporter& reporter) {
        return replay_progress([&reporter](const Progress& progress) { reporter.progress(progress); });
    }

    // The mean of the answers at the moments of the last periods before the asked moment.
    Answer mean_answer(StoredRun& run, Reporter& reporter) const {
        const AskedMoment asked = find_moment(run, asks_.moment);
        if (foreign_) check_known(asked, run);
        const bool replay = !asks_.no_replay && run.brings_back(asked.step);
        if (!replay && asks_for_forces())
            throw UserError(
                "--average: forces on walls and overlaps are not kept, and nothing is brought back here; "
                "leave "
                "--no-replay out, or run the scene again with output.checkpoints");
        MeanAnswer mean(asks_.limit);
        std::optional<Histogram> histogram;
        if (asks_.histogram) histogram.emplace(*asks_.histogram);
        std::size_t moments = 0, without_grain = 0;
        double bin = 0;
        see_periods(run, asked, *asks_.average, replay, watcher_of(reporter), [&](Snapshot snapshot) {
            ++moments;
            // Grains may come and go, but the bins must be the same at all moments.
            if (bin == 0 && snapshot.frame.size() > 0) bin = snapshot.bin();
            snapshot.bin_width = bin;
            if (asks_.grain && !snapshot.place_of(*asks_.grain))
                ++without_grain;
            else if (histogram)
                named("--histogram", [&] { return histogram->add(snapshot); });
            else
                mean.add(answer_of(run, snapshot, reporter), snapshot.frame.time);
        });
        if (moments == 0)
            throw UserError("--average: {} kept no moment in the {} before {:.6g} s", run.path().string(),
                            counted(*asks_.average, "period"), asked.time);
        if (without_grain == moments)
            throw UserError("--grain: no grain has the id {} at any of the {} moments", *asks_.grain,
                            moments);
        Answer answer = histogram
                            ? named("--histogram",
                                    [&] { return histogram->answer(static_cast<std::size_t>(asks_.bins)); })
                            : mean.mean();
        if (without_grain > 0)
            answer.notes.push_back(
                fmt::format("the grain is not there at {} of {}", without_grain, counted(moments, "moment")));
        answer.moment = {asked.time, asked.step,
                         fmt::format("mean over {} of the {} before", counted(moments, "moment"),
                                     counted(*asks_.average, "period"))};
        return answer;
    }

    Answer answer_of(StoredRun& run, const Snapshot& snapshot, Reporter& reporter) const {
        if (asks_.wall)
            return named("--wall", [&] { return wall_answer(snapshot, *asks_.wall, asks_.limit); });
        if (asks_.largest_overlap) return largest_overlap_answer(snapshot, asks_.limit);
        if (asks_.grain) return named("--grain", [&] { return grain_answer(snapshot, *asks_.grain); });
        if (asks_.where)
            return named("--where", [&] { return where_answer(snapshot, *asks_.where, asks_.limit); });
        if (asks_.profile)
            return named("--profile", [&] { return profile_answer(snapshot, *asks_.profile); });
        if (asks_.slice)
            return named("--slice", [&] { return slice_answer(snapshot, *asks_.slice, asks_.limit); });
        if (asks_.histogram)
            return named("--histogram", [&] {
                return histogram_answer(snapshot, *asks_.histogram, static_cast<std::size_t>(asks_.bins));
            });
        if (!asks_.pixel.empty())
            return named("--pixel", [&] {
                Answer there = PixelPicker(snapshot, asked_.scene, film_time())
                                   .at(asks_.pixel[0], asks_.pixel[1], asks_.through);
                if (there.tables[0].rows.empty())
                    throw UserError("nothing is at {:g},{:g}", asks_.pixel[0], asks_.pixel[1]);
                return there;
            });
        if (asks_.pairs)
            return named("--pair-distribution", [&] { return pair_distribution_answer(snapshot); });
        if (asks_.compare) {
            const AskedMoment earlier = find_moment(run, {.at = asks_.compare, .at_option = "--compare"});
            const bool replay = !earlier.kept && !asks_.no_replay;
            const Snapshot before = replay ? brought_back_snapshot(run, earlier, watcher_of(reporter))
                                           : kept_snapshot(run, earlier.nearest);
            return named("--compare", [&] { return compare_answer(before, snapshot, asks_.limit); });
        }
        return overview_of(snapshot);
    }

    // Adds the option's name to a mistake in a question, unless this names an option itself.
    template <class Ask>
    static auto named(const char* option, const Ask& ask) -> decltype(ask()) {
        try {
            return ask();
        } catch (const UserError& mistake) {
            const std::string words = mistake.what();
            throw UserError(words.starts_with("--") ? words : fmt::format("{}: {}", option, words));
        }
    }

    InspectRequest asks_;
    FilmedRun asked_;                   // the run, once it is open
    bool foreign_ = false;              // whether another program computed the run
    bool elsewhere_ = false;            // whether it was handed over to another engine
    std::vector<std::string> missing_;  // words for what an answer lacks
};

}  // namespace

Answer inspected(const InspectRequest& request, Reporter& reporter) {
    return Inspection(request).answer(reporter);
}

}  // namespace grainreel
