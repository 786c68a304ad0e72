#include "render/report/film_times.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "render/film/production/caption_holds.hpp"
#include "render/film/sampling/timeline.hpp"

namespace grainreel {
namespace {

// Of the film as planned, frame by frame, with those that hold a caption.
std::vector<double> planned_times(const Scene& scene, double first) {
    const Plan plan = make_plan(scene);
    std::vector<double> times;
    CaptionHolds holds(scene.film);
    for (const Instant& instant : instants_of(scene, plan.clock, plan.steps)) {
        if (instant.time < first - 0.5 * plan.clock.step) continue;
        times.insert(times.end(), 1 + static_cast<std::size_t>(holds.begin_at(instant.time)), instant.time);
    }
    return times;
}

// Whether the run may have left out frames on its way.
bool may_lack_frames(const Scene& scene) {
    return scene.drive.present && scene.film.periods == 0 &&
           std::any_of(scene.film.segments.begin(), scene.film.segments.end(),
                       [](const FilmSegment& segment) { return segment.kind == FilmSegment::Kind::locked; });
}

}  // namespace

FilmTimes film_times(const Scene& scene, std::int64_t frames, double first, bool whole) {
    FilmTimes result;
    try {
        result.times = planned_times(scene, first);
    } catch (const UserError&) {
        result.why_not =
            "This version of the program would not run the scene, so it cannot tell which moments the "
            "film shows.";
        return result;
    }
    const auto planned = static_cast<std::int64_t>(result.times.size());
    if (frames == planned) return result;
    if (!whole && !may_lack_frames(scene) && frames < planned) {
        result.times.resize(static_cast<std::size_t>(std::max<std::int64_t>(0, frames)));
        return result;
    }
    result.times.clear();
    result.why_not =
        "The film leaves out moments, and the run does not say which, so the film goes by itself. With "
        "film.periods in the scene it would be tied to charts and bed.";
    return result;
}

}  // namespace grainreel
