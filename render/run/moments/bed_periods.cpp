#include "render/run/moments/bed_periods.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace grainreel {

namespace {

double mean_diameter(const std::vector<Species>& species) {
    double sum = 0, count = 0;
    for (const Species& s : species) {
        sum += static_cast<double>(s.count) * s.diameter.mean;
        count += static_cast<double>(s.count);
    }
    return sum / count;
}

}  // namespace

BedPeriods::BedPeriods(const Scene& scene, const Clock& clock, const std::vector<Shot>& shots,
                       bool may_leave_out)
    : clock_(clock),
      wanted_(scene.film.periods),
      may_leave_out_(may_leave_out),
      diameter_(mean_diameter(scene.species)),
      multiple_(diameter_) {
    for (const Shot& shot : shots) first_.emplace(shot.segment, shot.step);
}

void BedPeriods::note(std::int64_t step, double height) {
    const int before = multiple_.value();
    multiple_.add(number_of(step), height);
    const bool as_wanted = wanted_ > 0 && wanted_ % multiple_.value() == 0;
    if (multiple_.value() != before && !as_wanted) news_.push_back(news_of(step));
}

Rhythm BedPeriods::rhythm() const {
    if (clock_.changes.empty())
        return Rhythm(static_cast<double>(clock_.steps_per_period / PeriodMultiple::kPhases));
    return Rhythm(0, 1.0 / PeriodMultiple::kPhases);
}

std::int64_t BedPeriods::number_of(std::int64_t step) const {
    return std::llround(clock_.cycles(step) * PeriodMultiple::kPhases);
}

int BedPeriods::found() const {
    return clock_.steps_per_period > 0 ? multiple_.value() : 0;
}

std::vector<int> BedPeriods::possible() const {
    if (wanted_ > 0) return {wanted_};
    std::vector<int> all{1};
    for (int periods = 2; periods <= PeriodMultiple::kMost && clock_.steps_per_period > 0; ++periods)
        all.push_back(periods);
    return all;
}

bool BedPeriods::shows(const FilmSegment& rule, const Shot& shot) const {
    if (!may_leave_out_ || rule.kind != FilmSegment::Kind::locked || clock_.steps_per_period == 0)
        return true;
    const std::int64_t periods =
        std::llround(clock_.cycles(shot.step) - clock_.cycles(first_.at(shot.segment)));
    return periods % spanning(rule, shown()).every == 0;
}

std::string BedPeriods::news_of(std::int64_t step) const {
    const int periods = multiple_.value();
    const double time = clock_.time(step);
    if (periods == 1)
        return fmt::format("from {:.3g} s on the bed repeats itself every period of the drive again", time);
    std::string text = fmt::format(
        "from {:.3g} s on the bed repeats itself only every {} periods of the drive (from one period to the "
        "next its centre of mass differs by {:.2g} grain diameters)",
        time, periods, multiple_.difference() / diameter_);
    if (wanted_ == 0 && !may_leave_out_)
        return text +
               fmt::format(
                   "; displacements and means go by {} periods, but locked frames jump; with every = 2 "
                   "or 4 they may not",
                   periods);
    if (wanted_ == 0)
        return text + fmt::format(
                          "; locked frames, displacements and means go by {} periods; film.periods = 1 "
                          "lets them go by one",
                          periods);
    return text + fmt::format(
                      ", but film.periods is {}: locked frames jump, and displacements and means show "
                      "the bed's flight",
                      wanted_);
}

}  // namespace grainreel
