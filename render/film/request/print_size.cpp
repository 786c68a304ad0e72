#include "render/film/request/print_size.hpp"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"

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

}  // namespace grainreel
