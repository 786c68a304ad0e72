#include "render/picture/grains/lit_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {
namespace {

// The same formula as light_as() in light-inl.hpp, seen straight on and with nothing around.
Colour lit(const Vec3& normal, const Colour& albedo) {
    const Lamp lamp;
    const Vec3 key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]), eye(0, 0, -1);
    const double falls = std::max(0.0, normal.dot(key));
    const double ambient = lamp.ground + (lamp.sky - lamp.ground) * (0.5 + 0.5 * normal.y());
    const double t = std::clamp(normal.dot(eye) / lamp.rim_width, 0.0, 1.0);
    const double rim = lamp.rim + (1 - lamp.rim) * t * t * (3 - 2 * t);
    const double gloss = std::max(0.0, normal.dot((key + eye).normalized()));
    const double shine = lamp.shine * std::pow(gloss, 32) * std::min(4 * falls, 1.0);
    const auto channel = [&](double srgb) {
        return to_srgb(std::clamp(to_linear(srgb) * (ambient + lamp.key * falls) * rim + shine, 0.0, 1.0));
    };
    return {channel(albedo.red), channel(albedo.green), channel(albedo.blue)};
}

}  // namespace

void draw_lit_ball(cairo_t* on, double x, double y, double radius, const Colour& colour) {
    // Drawn as a small picture of the lit hemisphere, cut out by a smooth circle.
    const int side = 2 * static_cast<int>(std::ceil(radius)) + 2;
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, side);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(stride) * side);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            double u = (column + 0.5 - 0.5 * side) / radius, v = (0.5 * side - row - 0.5) / radius;
            const double length = std::hypot(u, v);
            if (length > 1) {
                u /= length;
                v /= length;
            }
            const Vec3 normal(u, v, -std::sqrt(std::max(0.0, 1 - u * u - v * v)));
            const Colour shade = lit(normal, colour);
            const std::array<double, 3> channels = {shade.blue, shade.green, shade.red};
            for (std::size_t c = 0; c < 3; ++c)
                pixels[static_cast<std::size_t>(row) * stride + 4 * static_cast<std::size_t>(column) + c] =
                    static_cast<std::uint8_t>(std::lround(255 * channels[c]));
        }
    cairo_surface_t* ball =
        cairo_image_surface_create_for_data(pixels.data(), CAIRO_FORMAT_RGB24, side, side, stride);
    cairo_set_source_surface(on, ball, x - 0.5 * side, y - 0.5 * side);
    cairo_new_path(on);
    cairo_arc(on, x, y, radius, 0, 2 * M_PI);
    cairo_fill(on);
    cairo_set_source_rgb(on, 0, 0, 0);  // lets go of the surface
    cairo_surface_destroy(ball);
}

}  // namespace grainreel
