#include "render/film/sources/film_request.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

namespace {

constexpr double usual_dpi = 300;  // what journals ask for

}  // namespace

double dots_an_inch(const PrintSize& print) {
    return print.dpi.value_or(print.width_mm ? usual_dpi : 0);
}

void fit_to_paper(Film& film, const PrintSize& print) {
    if (!print.width_mm) return;
    constexpr double inch = 25.4;  // mm
    constexpr double most = 16384;
    const double width = std::round(*print.width_mm / inch * dots_an_inch(print));
    const double height = std::round(width * film.height / film.width);
    if (width < 16 || height < 16 || width > most || height > most)
        throw UserError(fmt::format("--width-mm: {} mm at {} dpi are {} x {} pixels; a side has 16 to {}",
                                    *print.width_mm, dots_an_inch(print), width, height, most));
    film.width = static_cast<int>(width);
    film.height = static_cast<int>(height);
}

ThreadPlan plan_threads(int processors, bool film, std::int64_t grains) {
    const int useful = useful_threads(processors, grains);
    if (!film) return {useful, 1, 1};
    // On one or two processors the engine and the film take turns with all of them; beyond, the film gets
    // processors of its own.
    if (processors <= 2) return {std::min(useful, processors), 1, 1, true};
    const int share = std::max(1, processors / 6);
    return {std::min(useful, processors - processors / 3), share, share};
}

ThreadPlan drawing_threads(int wanted) {
    const int processors = wanted > 0 ? wanted : usable_processors();
    const int raster = std::max(1, processors / 2);
    return {0, raster, std::max(1, processors - raster)};
}

}  // namespace grainreel
