// From a frame to a picture: grains, walls and the words around them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/marks/force_marks.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// ms a frame. Only measured on demand, because OpenGL has to be waited for after each stage. occlusion:
// finding neighbours and what shades a grain; shading: all light on grains; shadow: the ground's.
struct DrawTimes {
    double upload = 0, spheres = 0, shading = 0, occlusion = 0, shadow = 0, walls = 0, overlay = 0,
           readback = 0;
};

// What a picture of one moment points out.
struct PointedOut {
    std::vector<std::int32_t> grains;  // ids, rising; all others are seen through. None: as without
    std::vector<PointForce> forces;    // each an arrow
};

class Renderer {
  public:
    // Makes an off-screen OpenGL context, current on the calling thread: construct, use and destroy it on one
    // thread. raster_threads: of the software rasteriser, >= 1. Throws RunError when no context is to be had.
    Renderer(const FilmedScene& scene, int raster_threads, gl::Provider provider = gl::Provider::automatic);
    // Likewise, with a layout other than plan_layout()'s: bare_layout() leaves out all words.
    Renderer(const FilmedScene& scene, const PictureLayout& layout, int raster_threads,
             gl::Provider provider);
    ~Renderer();

    // playback: what the caption says of time ("slow motion, 1/10 speed"). film_time: s since the film's
    // first frame, where a camera that moves is. The size is the scene's film size.
    const Picture& draw(const Frame& frame, const std::string& playback, double film_time = 0);

    // The same into a picture of one's own: empty, or one that this renderer has drawn into before.
    void draw_into(Picture& picture, const Frame& frame, const std::string& playback, double film_time);

    const View& view() const;  // of the last picture
    // The film's first frame, from which start heights are counted; without a call, the first one drawn.
    void start_from(const Frame& frame);
    // Points this out in all pictures from now on.
    void point_out(PointedOut what);
    // A frame before the next one drawn, which leaves trails but no picture.
    void remember(const Frame& frame);

    // What of all that was drawn lies beyond the ends of the colour bar, and which labels have had no grain;
    // empty for nothing.
    std::string last_note() const;

    std::string gl_description() const;  // vendor, renderer and version of the context
    std::string gl_note() const;         // why it is not the context one would have expected; mostly empty

    // The same picture, and what each of its stages cost.
    DrawTimes draw_timed(const Frame& frame, const std::string& playback);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
