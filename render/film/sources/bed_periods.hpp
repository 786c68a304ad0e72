// Beds that repeat themselves only every so many periods of the drive: which locked frames their film shows,
// and means over such periods.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/measure/bed/bed_motion.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class BedPeriods {
  public:
    // shots: of the whole film; which of them are shown counts from the first of a segment, so that a run
    // that is taken up shows the same. may_leave_out: some of them; else all are shown.
    // segments: of the film, which need not be the scene's own.
    BedPeriods(const FilmedScene& scene, const Clock& clock, const std::vector<Shot>& shots,
               const std::vector<FilmSegment>& segments, bool may_leave_out);
    BedPeriods(const FilmedScene& scene, const Clock& clock, const std::vector<Shot>& shots,
               bool may_leave_out)
        : BedPeriods(scene, clock, shots, segments_of(scene.film), may_leave_out) {}

    // What measures say by then (columns bed_periods and period_difference_m).
    void note(std::int64_t step, int periods, double difference);

    // What the film goes by: the scene's, or what was found.
    int shown() const { return wanted_ > 0 ? wanted_ : found_; }
    // All that it may go by.
    std::vector<int> possible() const;
    // Whether the film shows the picture that a segment of it takes at that step.
    bool shows(const FilmSegment& rule, const Shot& shot) const;
    // A line for each change, for the user to know.
    const std::vector<std::string>& news() const { return news_; }

  private:
    std::string news_of(std::int64_t step, double difference) const;

    const Clock clock_;
    const int wanted_;
    const bool may_leave_out_;
    const double diameter_;  // m, mean
    // Whether the film has locked frames, and shows displacements over periods or means of them.
    bool locks_ = false, means_ = false;
    int found_ = 1;
    std::map<int, std::int64_t> first_;  // step at which a segment begins
    std::vector<std::string> news_;
};

// Puts grains where they were on average over whole periods of the drive, so that only drift is left.
// Positions become means over the moments, velocities how far the span has moved things, of grains and
// bodies. moments: by rising time, the first of them closes the span and is not in the mean, the last is the
// frame's own. span: s between these two. depth: m, along x, after which a periodic container repeats; 0 for
// none. A grain that was not there at all of the moments stays as it is.
void set_mean(Frame& frame, const std::vector<FramePtr>& moments, double span, double depth);

}  // namespace grainreel
