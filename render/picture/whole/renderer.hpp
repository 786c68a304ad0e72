// Makes a picture of a frame: the grains, the walls and the words around them. Everything in render/picture
// is put together here; films and the library know only this header and few others. It includes nothing of
// Cairo. A frame must give the same bytes for any number of threads, whatever was drawn before. tests/draw
// compares pictures with those in tests/draw/golden.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/state/contact.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/marks/force_marks.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class PdfPage;
struct DrawingContext;  // render/picture/base/canvas.hpp

// ms that the stages of a frame take. They are measured only on demand, because measuring waits for OpenGL
// after each stage. occlusion: the search for neighbours that shade a grain; shading: all light on grains;
// shadow: the shadow on the ground.
struct DrawTimes {
    double upload = 0, spheres = 0, shading = 0, occlusion = 0, shadow = 0, walls = 0, overlay = 0,
           readback = 0;
};

// What a picture of one moment points out.
struct PointedOut {
    std::vector<std::int32_t> grains;  // ids, rising; all others are seen through. Empty: none is pointed out
    std::vector<PointForce> forces;    // each is drawn as an arrow
};

class Renderer {
  public:
    // Makes an off-screen OpenGL context that is current on the calling thread. Construct, use and destroy
    // the renderer on one thread. raster_threads: threads of the software rasteriser, >= 1. Throws RunError
    // when there is no context. kept: the context of an earlier renderer on this thread, which is taken in
    // place of a new one; the pictures are the same.
    Renderer(const FilmedScene& scene, int raster_threads, gl::Provider provider = gl::Provider::automatic,
             std::shared_ptr<DrawingContext> kept = nullptr);
    // Takes another layout than plan_layout() would give: bare_layout() leaves out all words.
    Renderer(const FilmedScene& scene, const PictureLayout& layout, int raster_threads, gl::Provider provider,
             std::shared_ptr<DrawingContext> kept = nullptr);
    ~Renderer();

    // Draws a frame in the size of the scene's film. playback: the caption of time ("slow motion, 1/10
    // speed"). film_time: s since the film's first frame, for a camera that moves.
    const Picture& draw(const Shot& frame, const std::string& playback, double film_time = 0);

    // Draws into a picture of the caller's: an empty one, or one that this renderer has drawn into before.
    void draw_into(Picture& picture, const Shot& frame, const std::string& playback, double film_time);

    // Draws the picture on a page of PDF, its words as text.
    void draw_page(PdfPage& page, const Shot& frame, const std::string& playback, double film_time);

    const View& view() const;  // view of the last picture
    // Gives the film's first frame, which decides the grains' heights at the start. Without a call the first
    // frame that is drawn decides them.
    void start_from(const Shot& frame);
    // Points out these grains and forces in all pictures from now on.
    void point_out(PointedOut what);
    // Takes a frame that is not drawn but leaves trails.
    void remember(const Shot& frame);

    // Says how much of what was drawn lies beyond the ends of the colour bar, and which labels have had no
    // grain. Empty when there is nothing to say.
    std::string last_note() const;

    std::shared_ptr<DrawingContext> context() const;  // for a next renderer
    std::string gl_description() const;               // vendor, renderer and version of the context
    std::string gl_note() const;  // why it is not the kind that one would expect; empty if it is

    // Draws the same picture and tells what each of its stages cost.
    DrawTimes draw_timed(const Shot& frame, const std::string& playback);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
