// A run that lies on disk, as a source of any of its moments (RevisitedRun), and which moments its film
// shows. Where the schedule is that of the run's own film, they are those of that film (film_times.csv); else
// they follow from the segments as in a run.
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
#include "engine/run/driver/kept_moments.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/recorded_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmOfRun {
  public:
    // sets: those that the run's scene was read with.
    FilmOfRun(const RecordedRun& run, const Assignments& sets);

    // By rising step, as far as the run has come. Throws UserError when the film would have too many.
    std::vector<Shot> shots() const;
    // Periods of the drive after which the bed repeats itself, as the film has it then.
    int periods_at(std::int64_t step) const;
    // How far the run has come; it may have no frame of that.
    std::int64_t last_step() const { return last_; }
    // Without its grains.
    Frame moment(std::int64_t step) const;
    // The segment that a moment belongs to, and s of film until its picture would come.
    struct Place {
        int segment = 0;
        double time = 0;
    };
    Place place_of(std::int64_t step) const;

  private:
    void read_film_times();
    void read_periods();
    // What the bed's rhythm leaves of the shots.
    std::vector<Shot> with_bed(const std::vector<Shot>& shots) const;

    const RecordedRun& run_;
    bool same_ = true;  // the schedule, as in the run's own film, which there is
    std::int64_t last_ = 0;
    std::set<std::int64_t> filmed_;        // steps, of the run's own film
    std::vector<double> steps_, periods_;  // of rows of measures.csv
    std::vector<double> differences_;      // m
};

// A run that lies on disk, as a source of any of its moments: those that it kept (RecordedRun), and the
// others brought back from its checkpoints. Where that cannot be, or must not be, a picture shows the kept
// moment that is nearest, and news() counts them.

class RevisitedRun final : public FrameSource, private PartSupply {
  public:
    // sets: as for a RecordedRun. replay: false: nothing is brought back. sharers: how many runs have the
    // machine at once. Throws UserError as above.
    RevisitedRun(const std::filesystem::path& folder, const Assignments& sets, bool replay, int sharers = 1);

    // Frames that are damaged are left out of what was kept, with a line of news (RecordedRun).
    void leave_out_damaged();

    const RecordedRun& record() const { return run_; }
    const Clock& clock() const { return run_.clock(); }
    // The pictures of its scene's film, as far as the run has come, or as the run's own film has them.
    const FilmOfRun& film() const { return film_; }
    // The film's segments; without means and exposures where these are not to be had.
    std::vector<FilmSegment> segments() const;
    // Whether a picture of that step shows it, and not another one.
    bool has(std::int64_t step) const;
    // The step that a picture of this one shows.
    std::int64_t shown(std::int64_t step) const;
    bool has_all(const Pictures& pictures) const;
    // Whether it would be brought back.
    bool is_brought_back(std::int64_t step) const;
    // Throws UserError when what is brought back on the way to the step is another run.
    void prove(std::int64_t step) {
        reachable_.prove(step, [](double) { return true; });
    }
    // Why not all of its moments can be had; empty where they can.
    std::string why_not_all() const;
    // Asked while a replay goes on, with its share; the usual go_on is asked too.
    void watch_replay(ReplayWatcher watcher) { watcher_ = std::move(watcher); }

    const FilmedScene& scene() const override { return run_.scene(); }
    Supply supply() const override;
    Span span() const override;
    const FrameArchive* archive() const override { return run_.archive(); }
    std::vector<Frame> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override;
    // The same by steps, of which each is shown as it is or by the nearest that was kept.
    void start(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments);
    std::optional<Taken> next(const GoOn& go_on) override;
    std::vector<std::string> news() const override;

    // Grains and container alone of a step that it has. Null when told to stop.
    FramePtr grains(std::int64_t step, const GoOn& go_on);

  private:
    FramePtr at(std::int64_t step) const override;
    std::vector<Touch> touches(const Frame& frame) const override;
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override;
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame& frame) const override;

    std::vector<Shot> shots_of(const Pictures& pictures) const;
    bool wants_touches() const;
    // Empty when told to stop.
    std::optional<ReachableMoments::Found> take(std::int64_t step, bool touches, const GoOn& go_on);
    bool keep_moments_until(std::int64_t step, const GoOn& go_on);

    RecordedRun run_;
    const bool replay_;
    ReachableMoments reachable_;
    FilmOfRun film_;
    ReplayWatcher watcher_;
    std::vector<Shot> shots_;
    std::vector<FilmSegment> segments_;
    KeptMoments kept_;
    std::set<std::int64_t> wanted_;             // steps of moments that later pictures are made of
    std::size_t next_ = 0;                      // of the shots
    std::optional<std::int64_t> brought_back_;  // the step whose frame has its contacts with it
};

}  // namespace grainreel
