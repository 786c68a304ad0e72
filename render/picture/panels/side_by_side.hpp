// Draws several scenes at one moment. Each has a panel with a caption; title, clock, legend and scale bar
// that hold for all of them stand above and below the panels. This header includes nothing of Cairo, since
// films include it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class PdfPage;

// Lays out the panels in a picture of the film's size. The layout has no places when the picture is too
// small.
PanelLayout layout_of(const std::vector<Panel>& panels, const Film& film);

class SideBySide {
  public:
    // film: gives size, title and background of the whole picture. Each panel has an OpenGL context of its
    // own: construct, use and destroy on one thread. Throws RunError when there is no context.
    SideBySide(const std::vector<Panel>& panels, const Film& film, int raster_threads, gl::Provider provider);
    ~SideBySide();

    // frames: one for each panel, in their order. clock: which of them the clock shows. segment: number of
    // the film's segment, which decides the panels' captions of time. film_time: s since the film's first
    // frame, for cameras that move.
    const Picture& draw(const std::vector<ShotPtr>& frames, std::size_t segment = 0, std::size_t clock = 0,
                        double film_time = 0);

    // The pictures count heights at the start from these frames, and not from the first that is drawn.
    void start_from(const std::vector<ShotPtr>& frames);
    // Takes frames that are not drawn but leave trails.
    void remember(const std::vector<ShotPtr>& frames);

    // Draws the same on a page of PDF, its words as text.
    void draw_page(PdfPage& page, const std::vector<ShotPtr>& frames, std::size_t segment, std::size_t clock,
                   double film_time);

    const PanelLayout& layout() const;
    std::string last_note() const;  // the notes of all renderers
    std::string gl_description() const;
    std::string gl_note() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
