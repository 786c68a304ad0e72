#include "render/film/sources/picture_parts.hpp"

#include <algorithm>

#include "engine/questions/snapshot.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/period_choice.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

PictureParts::PictureParts(const FilmedScene& scene, const Clock& clock, std::int64_t first)
    : shows_(scene.film.shows),
      clock_(clock),
      first_(first),
      depth_(scene.container.periodic_depth ? scene.container.depth : 0) {}

std::vector<std::int64_t> PictureParts::earlier(std::int64_t step, int periods) const {
    if (!needs_displacement(shows_)) return {};
    const std::int64_t before = clock_.changes.empty() ? step - periods * clock_.steps_per_period
                                                       : clock_.step_at(clock_.cycles(step) - periods);
    if (before < first_) return {};
    return {before};
}

// Steps of the exposure. A picture near the run's beginning is exposed for a shorter time.
std::vector<std::int64_t> PictureParts::exposed(std::int64_t step, const FilmSegment& rule,
                                                int periods) const {
    std::vector<std::int64_t> over = exposed_steps({step, 0}, rule, clock_, periods);
    std::erase_if(over, [&](std::int64_t one) { return one < first_; });
    return over;
}

std::vector<std::int64_t> PictureParts::averaged(std::int64_t step, const FilmSegment& rule,
                                                 int periods) const {
    return averaged_steps({step, 0}, rule, clock_, periods);
}

std::vector<WantedState> PictureParts::moments(std::int64_t step, const FilmSegment& rule,
                                               int periods) const {
    std::vector<WantedState> all;
    for (const std::int64_t one : earlier(step, periods)) all.push_back({one, false});
    for (const std::int64_t one : exposed(step, rule, periods)) all.push_back({one, true});
    for (const std::int64_t one : averaged(step, rule, periods))
        if (std::max(one, first_) != step) all.push_back({std::max(one, first_), false});
    if (const std::optional<Way> way = way_between({step, 0}, rule, clock_, periods))
        all.push_back({std::max(way->from, first_), false});
    return all;
}

void PictureParts::add(Shot& shot, const FilmSegment& rule, int periods, Beside beside,
                       const OtherMoments& others) const {
    for (const std::int64_t step : earlier(shot.step, periods))
        if (const StatePtr before = others(step))
            shot.displacement = displacement_since(*before, shot, periods, depth_);
    for (const std::int64_t step : exposed(shot.step, rule, periods))
        if (const StatePtr moment = others(step))
            shot.exposed.push_back(std::make_shared<const Shot>(*moment));
    shot.touches = std::move(beside.touches);
    shot.worn = std::move(beside.worn);
    shot.flowed_out = beside.flowed_out;
    shot.measures = std::move(beside.measures);
    shot.measure_rows = beside.measure_rows;
    add_mean(shot, rule, periods, others);
    if (const std::optional<Way> way = way_between({shot.step, 0}, rule, clock_, periods))
        if (const StatePtr before = others(std::max(way->from, first_)))
            set_on_way(shot, *before, way->share, depth_);
}

// Adds the mean. Before the run's first step the grains are taken to have been where they were at that step.
void PictureParts::add_mean(Shot& shot, const FilmSegment& rule, int periods,
                            const OtherMoments& others) const {
    const std::vector<std::int64_t> steps = averaged(shot.step, rule, periods);
    if (steps.empty()) return;
    const auto own = std::make_shared<const State>(places_of(shot));
    std::vector<StatePtr> moments;
    for (const std::int64_t step : steps) {
        const std::int64_t from = std::max(step, first_);
        moments.push_back(from == shot.step ? own : others(from));
        if (!moments.back()) return;
    }
    set_mean(shot, moments, static_cast<double>(shot.step - steps.front()) * clock_.step, depth_);
}

}  // namespace grainreel
