// A plot beside the grains, which goes with the film.
#pragma once

#include <cairo.h>

#include <array>
#include <memory>
#include <optional>

#include "engine/frame.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SidePlot {
  public:
    virtual ~SidePlot() = default;

    // False when nothing changed.
    virtual bool take(const Frame& frame) = 0;
    // What the values' axis spans, SI, none before there is a value; and another span for it, of plots that
    // stand together.
    virtual std::optional<std::array<double, 2>> limits() const = 0;
    virtual void show(const std::array<double, 2>& limits) = 0;
    // Top left corner at (x, y).
    virtual void draw(cairo_t* on, int x, int y) = 0;
};

// place: only its size counts. end: s, of the axis of time. expected: SI, of which size the unit of a
// column's values is at least, beside what the scene says of it.
std::unique_ptr<SidePlot> make_side_plot(const FilmedScene& scene, const FilmPlot& plot,
                                         const Rectangle& place, double end, const TypeScale& type,
                                         const Palette& palette, double expected = 0);

}  // namespace grainreel
