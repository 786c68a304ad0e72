#include "render/draw/spheres.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.hpp"
#include "render/draw/palette.hpp"
#include "render/draw/sphere_shaders.hpp"

namespace grainreel {
namespace {

std::array<float, 4> linear(const Colour& colour) {
    return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
            static_cast<float>(to_linear(colour.blue)), 1.0f};
}

constexpr gl::Framebuffer::Format grain_numbers{GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, true};

gl::Program make_program(const gl::Functions& gl, const char* name, const ShaderPair& shaders) {
    return gl::Program(gl, name, shaders.vertex, shaders.fragment);
}

}  // namespace

SpherePainter::SpherePainter(const gl::Functions& gl, const Scene& scene, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      nearest_(make_program(gl, "nearest grain", nearest_grain_shaders())),
      light_(make_program(gl, "grain light", grain_light_shaders())),
      seen_(gl, width, height, grain_numbers),
      instances_(gl),
      none_(gl),
      spheres_(gl),
      crowding_(gl),
      colours_(gl) {
    for (const Species& species : scene.species) palette_.push_back(linear(species.colour));
    instances_.bind();
    spheres_.buffer().bind();
    gl_.EnableVertexAttribArray(0);
    gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.VertexAttribDivisor(0, 1);
}

void SpherePainter::upload(const View& view, const Frame& frame) {
    count_ = frame.size();
    box_ = covered(view, frame);
    if (!box_) return;
    const std::size_t bytes = count_ * sizeof(staging_[0]);
    staging_.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3 at = view.to_view(frame.position[i]);
        staging_[i] = {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z()),
                       static_cast<float>(frame.radius[i])};
    }
    spheres_.buffer().fill(staging_.data(), bytes);
    const std::vector<Crowding>& crowding = density_.update(frame);
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3& slope = crowding[i].slope;
        staging_[i] = {static_cast<float>(slope.dot(view.right)), static_cast<float>(slope.dot(view.up)),
                       static_cast<float>(slope.dot(view.forward)), static_cast<float>(crowding[i].level)};
    }
    crowding_.buffer().fill(staging_.data(), bytes);
    for (std::size_t i = 0; i < count_; ++i) {
        GRAINREEL_CHECK(static_cast<std::size_t>(frame.species[i]) < palette_.size());
        staging_[i] = palette_[static_cast<std::size_t>(frame.species[i])];
    }
    colours_.buffer().fill(staging_.data(), bytes);
}

// A sphere reaches at most r / (z - r) in slope beyond its centre's (z the view depth): a bound that is a
// little wide, and the whole port for what comes near the eye.
std::optional<SpherePainter::Box> SpherePainter::covered(const View& view, const Frame& frame) const {
    double low_x = 1, low_y = 1, high_x = -1, high_y = -1;
    const double scale_x = 2 * view.focal / width_, scale_y = 2 * view.focal / height_;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 at = view.to_view(frame.position[i]);
        const double r = frame.radius[i];
        if (!view.orthographic && at.z() + r <= 0) continue;
        const bool close = !view.orthographic && at.z() <= 2 * r;
        const double depth = view.orthographic ? 1 : at.z() - r;
        const double reach = view.orthographic ? r : r * (1 + at.head<2>().norm() / at.z());
        if (close) return Box{-1, -1, 1, 1};
        const auto span = [&](double middle, double scale, double& low, double& high) {
            low = std::min(low, scale * (middle - reach / depth));
            high = std::max(high, scale * (middle + reach / depth));
        };
        span(view.orthographic ? at.x() : at.x() / at.z(), scale_x, low_x, high_x);
        span(view.orthographic ? at.y() : at.y() / at.z(), scale_y, low_y, high_y);
    }
    const double pixel_x = 4.0 / width_, pixel_y = 4.0 / height_;  // two pixels, for the smooth edges
    if (low_x > 1 || low_y > 1 || high_x < -1 || high_y < -1 || low_x >= high_x) return std::nullopt;
    return Box{static_cast<float>(std::max(-1.0, low_x - pixel_x)), static_cast<float>(std::max(-1.0, low_y - pixel_y)),
               static_cast<float>(std::min(1.0, high_x + pixel_x)), static_cast<float>(std::min(1.0, high_y + pixel_y))};
}

void SpherePainter::set_camera(const gl::Program& program, const View& view) const {
    program.use();
    program.set("orthographic", view.orthographic ? 1 : 0);
    program.set("centre", 0.5f * static_cast<float>(width_), 0.5f * static_cast<float>(height_));
    program.set("focal", static_cast<float>(view.focal));
}

void SpherePainter::find_nearest(const View& view) const {
    if (!box_) return;
    seen_.bind();
    const GLuint nothing[4] = {0, 0, 0, 0};
    const float farthest = 1;
    gl_.ClearBufferuiv(GL_COLOR, 0, nothing);
    gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    set_camera(nearest_, view);
    nearest_.set("size", static_cast<float>(width_), static_cast<float>(height_));
    nearest_.set("depth_range", static_cast<float>(view.nearest), static_cast<float>(view.farthest));
    instances_.bind();
    gl_.DrawArraysInstanced(GL_TRIANGLE_FAN, 0, 8, static_cast<GLsizei>(count_));
    gl_.Disable(GL_DEPTH_TEST);
}

void SpherePainter::paint(const View& view) const {
    if (!box_) return;
    set_camera(light_, view);
    light_.set("world_up", static_cast<float>(view.right.z()), static_cast<float>(view.up.z()),
               static_cast<float>(view.forward.z()));
    light_.set("box", box_->x0, box_->y0, box_->x1, box_->y1);
    light_.set("seen", 0);
    light_.set("spheres", 1);
    light_.set("crowding", 2);
    light_.set("colours", 3);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, seen_.texture());
    spheres_.bind(1);
    crowding_.bind(2);
    colours_.bind(3);
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    none_.bind();
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.Disable(GL_BLEND);
    gl_.ActiveTexture(GL_TEXTURE0);
}

}  // namespace grainreel
