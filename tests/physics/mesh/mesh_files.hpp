// Meshes made by tests and written as STL, and scenes that have them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

using Corners = std::vector<std::array<Vec3, 3>>;  // of triangles, m

inline void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Corners& to) {
    to.push_back({a, b, c});
    to.push_back({a, c, d});
}

// A box with its normals outwards; without its upper side if it is open.
inline Corners box_of_triangles(const Vec3& low, const Vec3& high, bool open = false) {
    const auto at = [&](int x, int y, int z) {
        return Vec3((x ? high : low).x(), (y ? high : low).y(), (z ? high : low).z());
    };
    Corners c;
    add_quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), c);
    add_quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), c);
    add_quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), c);
    add_quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), c);
    add_quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1), c);
    if (!open) add_quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), c);
    return c;
}

// A point of a circle about z.
inline Vec3 on_circle(double radius, double turns, double z) {
    const double angle = 2 * std::numbers::pi * turns;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// A cone that stands on its tip, which lies in the origin, open above.
inline Corners cone(double radius, double height, int facets) {
    Corners c;
    for (int k = 0; k < facets; ++k)
        c.push_back({Vec3(0, 0, 0), on_circle(radius, (k + 1.0) / facets, height),
                     on_circle(radius, double(k) / facets, height)});
    return c;
}

// A pipe about z, open at both ends.
inline Corners pipe(double radius, double low, double high, int facets) {
    Corners c;
    for (int k = 0; k < facets; ++k) {
        const double from = double(k) / facets, to = (k + 1.0) / facets;
        add_quad(on_circle(radius, from, low), on_circle(radius, to, low), on_circle(radius, to, high),
                 on_circle(radius, from, high), c);
    }
    return c;
}

// A disc about z.
inline Corners disc(double radius, double z, int facets) {
    Corners c;
    for (int k = 0; k < facets; ++k)
        c.push_back({Vec3(0, 0, z), on_circle(radius, double(k) / facets, z),
                     on_circle(radius, (k + 1.0) / facets, z)});
    return c;
}

class MeshFiles : public testing::Test {
  protected:
    // Writes the triangles as a text STL in the folder of the scene.
    void write(const std::string& name, const Corners& triangles) const {
        std::ofstream out(here / name);
        out << "solid made\n";
        for (const auto& corners : triangles) {
            out << "facet normal 0 0 0\nouter loop\n";
            for (const Vec3& v : corners)
                out << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", v.x(), v.y(), v.z());
            out << "endloop\nendfacet\n";
        }
        out << "endsolid made\n";
    }

    Scene read(const std::string& text, std::vector<std::string> sets = {}) const {
        return read_scene_text(text, here / "scene.toml", with_tested_precision(std::move(sets)));
    }

    // The line of the scene's text that holds `part`, counted from 1.
    static int line_of(const std::string& text, const std::string& part) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
        return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
    }

    test::TemporaryFolder here;
};

}  // namespace grainreel
