// Chooses the locked frames of a film whose bed repeats itself only every few periods of the drive, and makes
// means over such periods.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/measure/bed/bed_formulas.hpp"
#include "engine/measure/measures.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class PeriodChoice {
  public:
    // shots: all shots of the film. The shown ones are counted from the first shot of each segment, so that a
    // resumed run shows the same ones. may_leave_out: false if all shots must be shown. segments: those of
    // the film, which may differ from the scene's own.
    PeriodChoice(const FilmedScene& scene, const Clock& clock, const std::vector<Due>& shots,
                 const std::vector<FilmSegment>& segments, bool may_leave_out);
    PeriodChoice(const FilmedScene& scene, const Clock& clock, const std::vector<Due>& shots,
                 bool may_leave_out)
        : PeriodChoice(scene, clock, shots, segments_of(scene.film), may_leave_out) {}

    // Takes what the measures say at that step (columns bed_periods and period_difference_m).
    void note(std::int64_t step, int periods, double difference);

    // The number of periods that the film follows: the scene's number, or the one that was found.
    int shown() const { return wanted_ > 0 ? wanted_ : found_; }
    // All numbers of periods that the film may follow.
    std::vector<int> possible() const;
    // Whether the film shows the picture that a segment takes at that step.
    bool shows(const FilmSegment& rule, const Due& shot) const;
    // A line for the user about each change.
    const std::vector<std::string>& news() const { return news_; }

  private:
    std::string news_of(std::int64_t step, double difference) const;

    const Clock clock_;
    const int wanted_;
    const bool may_leave_out_;
    const double diameter_;  // m, mean diameter of the grains
    // locks_: the film has locked frames. means_: it shows displacements or means over periods.
    bool locks_ = false, means_ = false;
    int found_ = 1;
    std::map<int, std::int64_t> first_;  // for each segment, the step at which it begins
    std::vector<std::string> news_;
};

// The periods of the bed by step, as the rows of measures.csv tell them.
class MeasuredPeriods {
  public:
    struct Row {
        double step = 0;
        int periods = 1;
        double difference = 0;  // m, period_difference_m
    };
    MeasuredPeriods() = default;
    // Without the columns of the bed's periods there are no rows.
    explicit MeasuredPeriods(const MeasureTable& table);

    const std::vector<Row>& rows() const { return rows_; }
    // The periods that the run had found by that step; 1 before its first row.
    int at(std::int64_t step) const;

  private:
    std::vector<Row> rows_;
};

// Puts grains where they were on average over whole periods of the drive, so that only drift is left.
// Positions of grains and bodies become means over the moments; velocities become the displacements over the
// span, divided by it. moments: by rising time; the first one begins the span and is not in the mean, the
// last one is the frame's own. span: s between these two. depth: period in m of a periodic container, along
// x; 0 for none. A grain that is missing at some of the moments stays as it is. Nothing is done if the number
// of bodies differs between the moments.
void set_mean(State& frame, const std::vector<StatePtr>& moments, double span, double depth);

// Puts grains and bodies on the straight way from where they were at an earlier moment to where they are.
// share: of that way, from 0 to 1. depth: as above. A grain that was not there stays where it is. Nothing is
// done if the number of bodies differs.
void set_on_way(State& frame, const State& before, double share, double depth);

}  // namespace grainreel
