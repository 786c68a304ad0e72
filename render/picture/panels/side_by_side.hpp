// Draws several scenes at one moment: a panel each, in one scale, with captions, under a common title and
// above a common clock, legend and scale bar.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Lays out these panels in a picture of the film's size; without places when it is too small.
PanelLayout layout_of(const std::vector<Panel>& panels, const Film& film);

class SideBySide {
  public:
    // film: size, title and background of the whole, or that it has none. Each panel has an OpenGL context of
    // its own: construct, use and destroy on one thread. Throws RunError when one is not to be had.
    SideBySide(const std::vector<Panel>& panels, const Film& film, int raster_threads, gl::Provider provider);
    ~SideBySide();

    // One frame a panel, in their order; the clock shows that of the frame `clock`. segment: of the film, for
    // what the panels say of time. film_time: s since the film's first frame, where cameras that move are.
    const Picture& draw(const std::vector<FramePtr>& frames, std::size_t segment = 0, std::size_t clock = 0,
                        double film_time = 0);

    const PanelLayout& layout() const;
    std::string last_note() const;  // as of Renderer, of all panels
    std::string gl_description() const;
    std::string gl_note() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The plots under panels that stand side by side. Those of one quantity have one span of values and of time,
// so that their curves can be compared.

class PanelPlots {
  public:
    // As many as the layout has places for.
    PanelPlots(const std::vector<Panel>& panels, const PanelLayout& layout, const TypeScale& type,
               const Palette& palette);

    // Takes one frame a panel. False when nothing changed.
    bool take(const std::vector<FramePtr>& frames);
    struct Placed {
        std::unique_ptr<SidePlot> plot;
        std::string quantity;
        Rectangle place;    // in the picture
        std::size_t panel;  // of its own
    };
    std::vector<Placed>& all() { return plots_; }

  private:
    void share_limits();
    std::vector<Placed> plots_;
};

}  // namespace grainreel
