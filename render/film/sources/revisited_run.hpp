// A run that lies on disk, as a source of any of its moments (RevisitedRun), and the moments that a film of
// it shows (FilmOfRun). If the schedule is that of the run's own film, a film of the run shows the same
// moments as that one (film_times.csv). Otherwise its moments follow from the segments, as they do while a
// scene is run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/questions/asked_run.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/recorded_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmOfRun {
  public:
    // sets: the changes with which the run's scene was read.
    FilmOfRun(const RecordedRun& run, const Assignments& sets);

    // The shots by rising step, as far as the run has come. Throws UserError when the film would have too
    // many.
    std::vector<Due> shots() const;
    // Periods of the drive after which the bed repeats itself, as the film takes it at that step.
    int periods_at(std::int64_t step) const;
    // The last step of the run; there may be no frame of it.
    std::int64_t last_step() const { return last_; }
    // The moment at a step, as a frame without grains.
    Frame moment(std::int64_t step) const;
    // The place of a moment in the film: its segment, and the time in s of film at which its picture would
    // come.
    struct Place {
        int segment = 0;
        double time = 0;
    };
    Place place_of(std::int64_t step) const;

  private:
    void read_film_times();
    void read_periods();
    // Those of the shots at which the bed looks alike (BedPeriods).
    std::vector<Due> with_bed(const std::vector<Due>& shots) const;

    const RecordedRun& run_;
    bool same_ = true;  // the run has a film of its own, with the same schedule
    std::int64_t last_ = 0;
    std::set<std::int64_t> filmed_;        // steps of the run's own film
    std::vector<double> steps_, periods_;  // steps and bed periods of the rows of measures.csv
    std::vector<double> differences_;      // m, period_difference_m of these rows
};

// A run that lies on disk, as a source of any of its moments. The run kept some of them (RecordedRun). The
// others are "brought back", which means computed again from its checkpoints. Where that is impossible or not
// allowed, a picture shows the nearest kept moment, and news() counts such pictures.
class RevisitedRun final : public FrameSource, private PartSupply {
  public:
    // sets: see RecordedRun. replay: false if nothing may be brought back. sharers: number of runs that share
    // the machine. Throws the UserErrors of FilmOfRun and RecordedRun.
    RevisitedRun(const std::filesystem::path& folder, const Assignments& sets, bool replay, int sharers = 1);

    // Leaves out damaged frames, with a line in news() (RecordedRun).
    void leave_out_damaged();

    const RecordedRun& record() const { return run_; }
    const Clock& clock() const { return run_.clock(); }
    // The moments that a film of this run shows.
    const FilmOfRun& film() const { return film_; }
    // The film's segments, without means and exposures when these cannot be had.
    std::vector<FilmSegment> segments() const;
    // Whether a picture of that step can show just this step, and not only a kept moment near it.
    bool has(std::int64_t step) const;
    // The step that is shown in a picture of `step`.
    std::int64_t shown(std::int64_t step) const;
    bool has_all(const Pictures& pictures) const;
    // Whether the step would be brought back.
    bool is_brought_back(std::int64_t step) const;
    // Replays to a kept moment on the way to the step, and compares the grains. Throws UserError when they
    // differ: then the checkpoints belong to another run. Only the first call compares.
    void prove(std::int64_t step) {
        reachable_.prove(step, [](double) { return true; });
    }
    // The reason why not all of its moments can be had; empty when they can.
    std::string why_not_all() const;
    // Sets a function that is called during a replay with the share that is done; the usual go_on is called
    // too.
    void watch_replay(ReplayWatcher watcher) { watcher_ = std::move(watcher); }

    const FilmedScene& scene() const override { return run_.scene(); }
    Supply supply() const override;
    Span span() const override;
    const FrameArchive* archive() const override { return run_.archive(); }
    std::vector<Frame> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override;
    // Starts with shots by their steps. Each step is shown itself, or by the nearest kept one.
    void start(const std::vector<Due>& shots, const std::vector<FilmSegment>& segments);
    std::optional<Taken> next(const GoOn& go_on) override;
    std::vector<std::string> news() const override;

    // Only the grains and the container at a step that it has. Null when told to stop.
    FramePtr grains(std::int64_t step, const GoOn& go_on);

  private:
    FramePtr at(std::int64_t step) const override;
    std::vector<Touch> touches(const Frame& frame) const override;
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override;
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame& frame) const override;

    std::vector<Due> shots_of(const Pictures& pictures) const;
    bool wants_touches() const;
    // Takes the moment of a step; empty when told to stop.
    std::optional<ReachableMoments::Found> take(std::int64_t step, bool touches, const GoOn& go_on);
    bool keep_moments_until(std::int64_t step, const GoOn& go_on);

    RecordedRun run_;
    const bool replay_;
    ReachableMoments reachable_;
    FilmOfRun film_;
    ReplayWatcher watcher_;
    std::vector<Due> shots_;
    std::vector<FilmSegment> segments_;
    KeptMoments kept_;
    std::set<std::int64_t> wanted_;  // steps whose moments later pictures need
    std::size_t next_ = 0;           // index of the next shot
    // Step of the last picture, if it was brought back, and its contacts.
    std::optional<std::int64_t> brought_back_;
    std::vector<Touch> touches_;
};

}  // namespace grainreel
