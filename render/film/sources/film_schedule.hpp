// The moments that a film of a run on disk shows. If the schedule is that of the run's own film, they are the
// moments of that one (film_times.csv). Otherwise they follow from the segments, as they do while a scene is
// run.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/period_choice.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmSchedule {
  public:
    // scene: the scene as it is drawn. sets: the changes with which it was read. Run and scene must outlive
    // this object.
    FilmSchedule(const StoredRun& run, const FilmedScene& scene, const Assignments& sets);

    // The shots by rising step, as far as the run has come. Throws UserError when the film would have too
    // many.
    std::vector<Due> shots() const;
    // Periods of the drive after which the bed repeats itself, as the film takes it at that step.
    int periods_at(std::int64_t step) const;
    // The last step of the run; there may be no frame of it.
    std::int64_t last_step() const { return last_; }
    // The moment at a step, as a frame without grains.
    State moment(std::int64_t step) const;
    // The place of a moment in the film: its segment, and the time in s of film at which its picture would
    // come.
    struct Place {
        int segment = 0;
        double time = 0;
    };
    Place place_of(std::int64_t step) const;

  private:
    void read_film_times();
    // Those of the shots at which the bed looks alike (PeriodChoice).
    std::vector<Due> with_bed(const std::vector<Due>& shots) const;

    const StoredRun& run_;
    const FilmedScene& scene_;
    bool same_ = true;  // the run has a film of its own, with the same schedule
    std::int64_t last_ = 0;
    std::set<std::int64_t> filmed_;  // steps of the run's own film
    MeasuredPeriods measured_;
};

}  // namespace grainreel
