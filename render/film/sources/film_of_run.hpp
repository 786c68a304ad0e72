// Which moments the film of a run that lies on disk shows. Where the schedule is that of the run's own film,
// they are those of that film (film_times.csv); else they follow from the segments as in a run.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/recorded_run.hpp"

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

}  // namespace grainreel
