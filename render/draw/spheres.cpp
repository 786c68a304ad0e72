#include "render/draw/spheres.hpp"

#include "engine/base/error.hpp"
#include "render/draw/palette.hpp"
#include "render/draw/sphere_shaders.hpp"

namespace grainreel {
namespace {

std::array<float, 4> linear(const Colour& colour) {
    return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
            static_cast<float>(to_linear(colour.blue)), 1.0f};
}

}  // namespace

SpherePainter::SpherePainter(const gl::Functions& gl, const Scene& scene, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      visibility_(width, height),
      light_(gl, "grain light", grain_light_shaders().vertex, grain_light_shaders().fragment),
      seen_(gl, width, height, {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}),
      none_(gl),
      spheres_(gl),
      crowding_(gl),
      colours_(gl) {
    for (const Species& species : scene.species) palette_.push_back(linear(species.colour));
}

void SpherePainter::find_visible(const View& view, const Frame& frame) {
    view_spheres_.resize(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 at = view.to_view(frame.position[i]);
        view_spheres_[i] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                            static_cast<float>(at.z()), static_cast<float>(frame.radius[i])};
    }
    visibility_.update(view, view_spheres_);
}

void SpherePainter::upload(const View& view, const Frame& frame) {
    if (visibility_.covered().empty()) return;
    upload_visibility();
    const std::size_t bytes = frame.size() * sizeof(staging_[0]);
    spheres_.buffer().fill(view_spheres_.data(), bytes);
    const std::vector<Crowding>& crowding = density_.update(frame);
    staging_.resize(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3& slope = crowding[i].slope;
        staging_[i] = {static_cast<float>(slope.dot(view.right)), static_cast<float>(slope.dot(view.up)),
                       static_cast<float>(slope.dot(view.forward)), static_cast<float>(crowding[i].level)};
    }
    crowding_.buffer().fill(staging_.data(), bytes);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        GRAINREEL_CHECK(static_cast<std::size_t>(frame.species[i]) < palette_.size());
        staging_[i] = palette_[static_cast<std::size_t>(frame.species[i])];
    }
    colours_.buffer().fill(staging_.data(), bytes);
}

void SpherePainter::upload_visibility() const {
    const PixelBox& box = visibility_.changed();
    gl_.BindTexture(GL_TEXTURE_2D, seen_.id());
    gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, width_);
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0, GL_RED_INTEGER,
                      GL_UNSIGNED_INT,
                      visibility_.seen().data() + static_cast<std::size_t>(box.y0) * width_ + box.x0);
    gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void SpherePainter::paint(const View& view) const {
    const PixelBox& box = visibility_.covered();
    if (box.empty()) return;
    light_.use();
    light_.set("orthographic", view.orthographic ? 1 : 0);
    light_.set("centre", 0.5f * static_cast<float>(width_), 0.5f * static_cast<float>(height_));
    light_.set("focal", static_cast<float>(view.focal));
    light_.set("world_up", static_cast<float>(view.right.z()), static_cast<float>(view.up.z()),
               static_cast<float>(view.forward.z()));
    const auto clip = [](int pixel, int size) {
        return 2 * static_cast<float>(pixel) / static_cast<float>(size) - 1;
    };
    light_.set("box", clip(box.x0, width_), clip(box.y0, height_), clip(box.x1, width_),
               clip(box.y1, height_));
    light_.set("seen", 0);
    light_.set("spheres", 1);
    light_.set("crowding", 2);
    light_.set("colours", 3);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, seen_.id());
    spheres_.bind(1);
    crowding_.bind(2);
    colours_.bind(3);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    none_.bind();
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.Disable(GL_BLEND);
}

}  // namespace grainreel
