// Which locked frames a film shows whose bed repeats itself only every so many periods of the drive.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/measure/period_multiple.hpp"
#include "engine/scene/scene.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/moments/agenda.hpp"

namespace grainreel {

class BedPeriods {
  public:
    // shots: of the whole film; which of them are shown counts from the first of a segment, so that a run
    // that is taken up shows the same. may_leave_out: some of them; else all are shown.
    BedPeriods(const Scene& scene, const Clock& clock, const std::vector<Shot>& shots, bool may_leave_out);

    // Of the moments that note() wants to know of.
    Rhythm rhythm() const;
    // height: m, of the centre of mass above the floor.
    void note(std::int64_t step, double height);

    // As found so far; 0 without a drive.
    int found() const;
    // What the film goes by: the scene's, or what was found.
    int shown() const { return wanted_ > 0 ? wanted_ : std::max(1, found()); }
    // All that it may go by.
    std::vector<int> possible() const;
    // Whether the film shows the picture that a segment of it takes at that step.
    bool shows(const FilmSegment& rule, const Shot& shot) const;
    // A line for each change, for the user to know.
    const std::vector<std::string>& news() const { return news_; }

  private:
    // Which of those moments a step is; they count on from period to period.
    std::int64_t number_of(std::int64_t step) const;
    std::string news_of(std::int64_t step) const;

    const Clock clock_;
    const int wanted_;
    const bool may_leave_out_;
    const double diameter_;  // m, mean
    PeriodMultiple multiple_;
    std::map<int, std::int64_t> first_;  // step at which a segment begins
    std::vector<std::string> news_;
};

}  // namespace grainreel
