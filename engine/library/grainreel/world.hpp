/// @file
/// What stays the same from frame to frame: the names of species, and walls.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "grainreel/vector.hpp"

namespace grainreel::v1 {

/// A wall of triangles, at rest.
struct Mesh {
    std::string name{};            ///< A name for messages and pictures.
    std::vector<Vector> points{};  ///< m.
    std::vector<std::array<std::int32_t, 3>>
        triangles{};     ///< Places in `points`; counter-clockwise from in front.
    bool glass = false;  ///< In pictures: solid from in front and glass from behind, so one can look inside.

    /// A parallelogram with a corner (m) and two edges (m).
    static Mesh plate(const std::string& name, const Vector& corner, const Vector& first,
                      const Vector& second);
    /// The six sides of a box between two corners, m. Their fronts face the inside; the box is of glass.
    static Mesh box(const std::string& name, const Vector& low, const Vector& high);
    /// Reads STL, OBJ or PLY, whose numbers are multiplied by `scale` to give m. Throws Error where the file
    /// is missing, damaged or of another kind.
    static Mesh from_file(const std::filesystem::path& file, double scale = 1);
};

/// The species by name, and walls. Wall k moves as Frame::bodies[2 + k] says.
struct World {
    std::string title{};                 ///< The title of files and pictures; may be empty.
    std::vector<std::string> species{};  ///< Names, each once; at least one.
    std::vector<double> density{};       ///< kg/m3, of each species; empty, or NaN, where it is not known.
    std::vector<Mesh> walls{};           ///< Of triangles.
};

}  // namespace grainreel::v1
