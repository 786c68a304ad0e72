#include "render/film/sampling/timeline.hpp"
#include "render/scene/filmed_scene.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

std::int64_t nearest_step(double time, const Clock& clock, std::int64_t steps) {
    return std::clamp<std::int64_t>(std::llround(time / clock.step), 0, steps);
}

std::int64_t nearest_step_at(double phase, double time, const Clock& clock, std::int64_t steps) {
    const double turns = phase - clock.initial_phase;
    if (!clock.changes.empty()) {
        const double at = turns - std::floor(turns), cycles = clock.cycles(nearest_step(time, clock, steps));
        double nearest = at + std::max(0.0, std::round(cycles - at));
        if (clock.step_at(nearest) > steps) --nearest;
        return nearest < 0 ? nearest_step(time, clock, steps) : clock.step_at(nearest);
    }
    const auto period = static_cast<double>(clock.steps_per_period);
    const std::int64_t first = std::llround((turns - std::floor(turns)) * period) % clock.steps_per_period;
    const double periods = std::round((time / clock.step - static_cast<double>(first)) / period);
    std::int64_t step = first + static_cast<std::int64_t>(periods) * clock.steps_per_period;
    if (step < 0) step += clock.steps_per_period;
    if (step > steps) step -= clock.steps_per_period;
    return step < 0 ? nearest_step(time, clock, steps) : step;
}

}  // namespace

std::size_t reference_of(const std::vector<FilmedScene>& scenes) {
    std::size_t reference = 0;
    double longest = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const Drive& drive = scenes[i].drive;
        if (!drive.present || 1 / drive.frequency <= longest * (1 + 1e-9)) continue;
        longest = 1 / drive.frequency;
        reference = i;
    }
    return reference;
}

std::vector<Instant> instants_of(const FilmedScene& film, const Clock& reference, std::int64_t steps) {
    std::vector<Instant> instants;
    for (const Shot& shot : film_schedule(film, reference, steps))
        instants.push_back({reference.time(shot.step), shot.segment});
    return instants;
}

std::vector<Shot> shots_at(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments,
                           const Clock& clock, std::int64_t steps) {
    std::vector<Shot> shots;
    for (const Instant& instant : instants) {
        const FilmSegment& rule = segments.at(static_cast<std::size_t>(instant.segment));
        const bool locked = rule.kind == FilmSegment::Kind::locked && clock.steps_per_period > 0;
        shots.push_back({locked ? nearest_step_at(rule.phase, instant.time, clock, steps)
                                : nearest_step(instant.time, clock, steps),
                         instant.segment});
    }
    // Where segments meet, a phase may lie a little before the moment shown last.
    for (std::size_t i = 1; i < shots.size(); ++i) shots[i].step = std::max(shots[i].step, shots[i - 1].step);
    return shots;
}

}  // namespace grainreel
