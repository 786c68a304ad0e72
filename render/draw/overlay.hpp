// The words around the picture, in gutters that no grain is drawn in. What never changes is drawn once.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <vector>

#include "render/draw/cairo_surface.hpp"
#include "render/draw/layout.hpp"
#include "render/draw/picture.hpp"
#include "render/draw/writer.hpp"

namespace grainreel {

// Title, legend, scale bar, axes and arrows in the first gutter. view: null while measuring.
TextSize static_part(const Writer& writer, const Scene& scene, const View* view, const PictureLayout& layout,
                     double width);
// Time, dial, drive and playback in the second one. Both return the size that they take, margins left out.
TextSize changing_part(const Writer& writer, const Scene& scene, const View* view, const Frame& frame,
                       const std::string& playback, double width, bool portrait);

class Overlay {
  public:
    Overlay(const Scene& scene, const Palette& palette, const PictureLayout& layout, const View& view);

    // Writes the gutters into the picture: all of them the first time, then only what changes. view: before
    // it follows anything.
    void write(Picture& picture, const Frame& frame, const std::string& playback, const View& view);

  private:
    void draw_first(const View& view);

    const Scene& scene_;
    const Palette palette_;
    const PictureLayout layout_;
    const TypeScale type_;
    CairoSurface first_, second_;
    View drawn_for_;
    bool first_written_ = false;
};

}  // namespace grainreel
