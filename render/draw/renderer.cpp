#include "render/draw/renderer.hpp"

#include <array>
#include <chrono>
#include <cstring>

#include "render/draw/container_drawing.hpp"
#include "render/draw/overlay.hpp"
#include "render/draw/spheres.hpp"

namespace grainreel {
namespace {

constexpr gl::TextureFormat bytes{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

// Adds up where the time of one frame goes; does nothing without a place to put it.
class Stopwatch {
  public:
    Stopwatch(const gl::Functions& gl, DrawTimes* times) : gl_(gl), times_(times) {}
    // Everything since the last call, or since the watch was made, belongs to `stage`.
    void lap(double DrawTimes::*stage) {
        if (!times_) return;
        gl_.Finish();
        const auto now = std::chrono::steady_clock::now();
        times_->*stage += std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
    }

  private:
    const gl::Functions& gl_;
    DrawTimes* times_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

struct Renderer::Impl {
    Impl(const Scene& s, int raster_threads, gl::Provider provider)
        : scene(s),
          palette(make_palette(s.film.background)),
          layout(plan_layout(s)),
          port(layout.port),
          view(frame_container(s, layout)),
          overlay(scene, palette, layout, view),
          context(gl::make_context(provider, raster_threads)),
          target(context->gl(), port.width, port.height, bytes),
          shape_painter(context->gl()),
          sphere_painter(context->gl(), s, port.width, port.height),
          clear_colour{static_cast<float>(palette.background.red),
                       static_cast<float>(palette.background.green),
                       static_cast<float>(palette.background.blue), 1.0f},
          picture(s.film.width, s.film.height),
          rows(static_cast<std::size_t>(port.width) * port.height * 4) {}

    Scene scene;
    Palette palette;
    PictureLayout layout;
    const Rectangle port;
    View view;
    Overlay overlay;
    std::unique_ptr<gl::Context> context;
    gl::Framebuffer target;
    ShapePainter shape_painter;
    SpherePainter sphere_painter;
    ContainerShapes shapes;
    std::array<float, 4> clear_colour;
    Picture picture;
    std::vector<std::uint8_t> rows;

    void draw(const Frame& frame, const std::string& playback, DrawTimes* times);
    void read_back();
};

void Renderer::Impl::draw(const Frame& frame, const std::string& playback, DrawTimes* times) {
    context->make_current();
    const gl::Functions& gl = context->gl();
    Stopwatch watch(gl, times);
    overlay.write(picture, frame, playback);
    watch.lap(&DrawTimes::overlay);
    const View eye = scene.film.camera.follow ? view.moved_by(frame.wall_offset) : view;
    sphere_painter.find_visible(eye, frame);
    watch.lap(&DrawTimes::spheres);
    sphere_painter.upload(eye, frame);
    watch.lap(&DrawTimes::upload);
    draw_container(scene, view, eye, frame, palette, scene.film.height, shapes);
    target.bind();
    gl.ClearBufferfv(GL_COLOR, 0, clear_colour.data());
    shape_painter.paint(shapes.behind, port.width, port.height);
    watch.lap(&DrawTimes::walls);
    sphere_painter.paint(eye);
    watch.lap(&DrawTimes::shading);
    shape_painter.paint(shapes.before, port.width, port.height);
    watch.lap(&DrawTimes::walls);
    read_back();
    watch.lap(&DrawTimes::readback);
}

void Renderer::Impl::read_back() {
    const gl::Functions& gl = context->gl();
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, port.width, port.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    const std::size_t row = static_cast<std::size_t>(port.width) * 4;
    for (int y = 0; y < port.height; ++y)
        std::memcpy(picture.pixel(port.x, port.y + y), rows.data() + row * (port.height - 1 - y), row);
}

Renderer::Renderer(const Scene& scene, int raster_threads, gl::Provider provider)
    : impl_(std::make_unique<Impl>(scene, raster_threads, provider)) {}

Renderer::~Renderer() = default;

const Picture& Renderer::draw(const Frame& frame, const std::string& playback) {
    impl_->draw(frame, playback, nullptr);
    return impl_->picture;
}

DrawTimes Renderer::draw_timed(const Frame& frame, const std::string& playback) {
    DrawTimes times;
    impl_->draw(frame, playback, &times);
    return times;
}

std::string Renderer::gl_description() const {
    return impl_->context->description();
}

std::string Renderer::gl_note() const {
    return impl_->context->note();
}

}  // namespace grainreel
