// One picture for print: pixels an inch and a width on paper.
#pragma once

#include <optional>

#include "render/scene/film.hpp"

namespace grainreel {

struct PrintSize {
    std::optional<double> dpi, width_mm;
    bool wanted() const { return dpi || width_mm; }
};

// 0 where the picture is not for print.
double dots_an_inch(const PrintSize& print);

// Gives the film so many pixels as the width on paper needs, with its own ratio of the sides. Throws
// UserError where a side would be too small or too large.
void fit_to_paper(Film& film, const PrintSize& print);

}  // namespace grainreel
