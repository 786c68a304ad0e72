#include "render/page/film/film_times.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/plan/plan.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sampling/held_frames.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// The frames of the film as planned, with those that hold a caption.
std::vector<double> planned_times(const FilmedScene& scene, double first) {
    const Plan plan = plan_with_film(scene);
    std::vector<double> times;
    CaptionHolds holds(scene.film);
    for (const Instant& instant : instants_of(scene, plan.clock, plan.steps)) {
        if (instant.time < first - 0.5 * plan.clock.step) continue;
        times.insert(times.end(), 1 + static_cast<std::size_t>(holds.begin_at(instant.time)), instant.time);
    }
    return times;
}

// Whether the run may have left out frames on its way.
bool may_lack_frames(const FilmedScene& scene) {
    return scene.drive.present && scene.film.periods == 0 &&
           std::any_of(scene.film.segments.begin(), scene.film.segments.end(),
                       [](const FilmSegment& segment) { return segment.kind == FilmSegment::Kind::locked; });
}

}  // namespace

std::optional<FilmTimes> kept_film_times(const std::filesystem::path& folder, std::int64_t frames) {
    const auto table = read_measures(folder / kFilmTimes);
    if (!table || frames <= 0 || static_cast<std::int64_t>(table->rows()) != frames) return std::nullopt;
    const auto& names = table->columns();
    const auto column =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), "time_s") - names.begin());
    if (column == names.size()) return std::nullopt;
    FilmTimes result;
    result.times = table->values(column, 0, table->rows());
    const bool finite = std::all_of(result.times.begin(), result.times.end(),
                                    [](double time) { return std::isfinite(time); });
    if (!finite || !std::is_sorted(result.times.begin(), result.times.end())) return std::nullopt;
    return result;
}

FilmTimes film_times(const FilmedScene& scene, std::int64_t frames, double first, bool whole) {
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
