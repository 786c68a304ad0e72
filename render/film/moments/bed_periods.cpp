#include "render/film/moments/bed_periods.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/scene/bed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

BedPeriods::BedPeriods(const FilmedScene& scene, const Clock& clock, const std::vector<Shot>& shots,
                       const std::vector<FilmSegment>& segments, bool may_leave_out)
    : clock_(clock),
      wanted_(scene.film.periods),
      may_leave_out_(may_leave_out),
      diameter_(mean_diameter(scene)) {
    for (const Shot& shot : shots) first_.emplace(shot.segment, shot.step);
    for (const auto& [number, step] : first_) {
        const FilmSegment& segment = segments.at(static_cast<std::size_t>(number));
        locks_ = locks_ || segment.kind == FilmSegment::Kind::locked;
        means_ = means_ || segment.average > 0;
    }
    means_ = means_ || (!shots.empty() && needs_displacement(scene.film.shows));
}

void BedPeriods::note(std::int64_t step, int periods, double difference) {
    if (periods == found_ || periods < 1) return;
    found_ = periods;
    const bool as_wanted = wanted_ > 0 && wanted_ % found_ == 0;
    if (!as_wanted) news_.push_back(news_of(step, difference));
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

std::string BedPeriods::news_of(std::int64_t step, double difference) const {
    const int periods = found_;
    const double time = clock_.time(step);
    if (periods == 1)
        return fmt::format("from {:.3g} s on the bed repeats itself every period of the drive again", time);
    std::string text = fmt::format(
        "from {:.3g} s on the bed repeats itself only every {} periods of the drive (from one period to the "
        "next its centre of mass differs by {:.2g} grain diameters)",
        time, periods, difference / diameter_);
    // What of the film goes by periods; the rest does not change with the bed's.
    const std::string means = means_ ? "displacements and means" : "";
    if (!locks_ && !means_) return text;
    if (wanted_ == 0 && !may_leave_out_) {
        if (means_) text += fmt::format("; {} go by {} periods", means, periods);
        if (locks_)
            text += fmt::format("{} locked frames jump; with every = 2 or 4 they may not",
                                means_ ? ", but" : ";");
        return text;
    }
    if (wanted_ == 0)
        return text + fmt::format("; {}{}{} go by {} periods; film.periods = 1 lets them go by one",
                                  locks_ ? "locked frames" : "", locks_ && means_ ? ", " : "", means,
                                  periods);
    return text + fmt::format(", but film.periods is {}: {}{}{}", wanted_, locks_ ? "locked frames jump" : "",
                              locks_ && means_ ? ", and " : "",
                              means_ ? means + " show the bed's flight" : "");
}

}  // namespace grainreel
