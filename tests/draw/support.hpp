// Scenes and frames made by hand, and measurements on pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/state/state.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel::test {

constexpr double pi = std::numbers::pi;
inline const Colour blue{0.337, 0.706, 0.914}, orange{0.902, 0.624, 0.0};

struct Grains {
    std::string name;
    std::int64_t count;
    double diameter;  // m
    Colour colour;
};

inline void add_species(FilmedScene& scene, const Grains& grains) {
    Species& s = scene.species.emplace_back();
    s.name = grains.name;
    s.count = grains.count;
    s.diameter = {SizeSpread::Kind::fixed, grains.diameter, grains.diameter, grains.diameter, 0};
    s.density = 2500;
    scene.colours.push_back(grains.colour);
}

// Gives the scene these species and no others.
inline void set_species(FilmedScene& scene, const std::vector<Grains>& all) {
    scene.species.clear();
    scene.colours.clear();
    for (const Grains& grains : all) add_species(scene, grains);
}

inline FilmedScene wedge(int width = 640, int height = 360) {
    FilmedScene scene;
    scene.title = "A wedge";
    scene.film.title = scene.title;
    scene.film.width = width;
    scene.film.height = height;
    set_species(scene, {{"small", 1500, 0.005, blue}, {"big", 120, 0.010, orange}});
    Container& c = scene.container;
    c.half_width = 0.075;
    c.depth = 0.04;
    c.height = 0.16;
    c.half_angle = 20 * pi / 180;
    c.slant_height = 0.1;
    scene.film.camera.frame = FramingScope::container;
    scene.film.look.ground = false;  // its shadow moves where walls are measured
    scene.drive.present = true;
    scene.drive.frequency = 20;
    scene.drive.amplitude = 0.002;
    return scene;
}

// The wedge as a camera sees it that looks along -x from very far away: y is to the right, z upwards.
inline FilmedScene straight_on() {
    FilmedScene scene = wedge(960, 540);
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    return scene;
}

struct Ball {
    Vec3 at;
    double radius = 0.005;
    int species = 0;
};

inline State frame_of(const std::vector<Ball>& balls) {
    State frame;
    for (const Ball& ball : balls) {
        frame.id.push_back(static_cast<std::int32_t>(frame.id.size()));
        frame.species.push_back(ball.species);
        frame.radius.push_back(ball.radius);
        frame.position.push_back(ball.at);
    }
    frame.velocity.assign(balls.size(), Vec3(0, 0, 0));
    frame.spin = frame.velocity;
    return frame;
}

inline View view_of(const FilmedScene& scene) {
    return frame_container(scene, plan_layout(scene));
}

// The pixels of the port that differ by `least` or more between two pictures: their number, and the box
// around them as seen from the port's corner.
struct Extent {
    int count = 0;
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};
// The box around all vertices, and how many there are.
inline Extent extent_of_vertices(const Shapes& shapes) {
    Extent extent;
    for (const Shapes::Vertex& vertex : shapes.vertices()) {
        ++extent.count;
        extent.left = std::min(extent.left, double{vertex.x});
        extent.right = std::max(extent.right, double{vertex.x});
        extent.top = std::min(extent.top, double{vertex.y});
        extent.bottom = std::max(extent.bottom, double{vertex.y});
    }
    return extent;
}
inline double difference(const Picture& a, const Picture& b, int x, int y) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]);
    return sum;
}
inline Extent changed(const Picture& a, const Picture& b, const Rectangle& port, double least = 3) {
    Extent extent;
    for (int y = port.y; y < port.y + port.height; ++y)
        for (int x = port.x; x < port.x + port.width; ++x) {
            if (difference(a, b, x, y) < least) continue;
            ++extent.count;
            extent.left = std::min(extent.left, x - port.x + 0.0);
            extent.right = std::max(extent.right, x - port.x + 1.0);
            extent.top = std::min(extent.top, y - port.y + 0.0);
            extent.bottom = std::max(extent.bottom, y - port.y + 1.0);
        }
    return extent;
}

// The hue in degrees; 0 is red.
inline double hue(const std::uint8_t* p) {
    const double r = p[0], g = p[1], b = p[2];
    return std::atan2(std::sqrt(3.0) * (g - b), 2 * r - g - b) * 180 / pi;
}
inline double hue(const Colour& c) {
    return std::atan2(std::sqrt(3.0) * (c.green - c.blue), 2 * c.red - c.green - c.blue) * 180 / pi;
}

}  // namespace grainreel::test
