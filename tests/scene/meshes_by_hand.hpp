// Meshes and files for tests of scenes with meshes.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

using TriangleByHand = std::array<Vec3, 3>;
using MeshByHand = std::vector<TriangleByHand>;

// Adds two triangles. Corners go counter-clockwise for an eye on the side of the normal.
inline void add_quad(MeshByHand& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
}

inline MeshByHand plate(double side) {
    MeshByHand mesh;
    const double h = 0.5 * side;
    add_quad(mesh, {-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0});
    return mesh;
}

// Sheets around a box that stands on z = 0 and is open above unless there is a lid. hole: m, side of a square
// hole in the middle of the floor; 0 for none.
inline MeshByHand box_of_sheets(double side, double height, bool lid = false, double hole = 0) {
    const double h = 0.5 * side, o = 0.5 * hole;
    const std::array<Vec3, 4> low{Vec3(-h, -h, 0), Vec3(h, -h, 0), Vec3(h, h, 0), Vec3(-h, h, 0)};
    const std::array<Vec3, 4> inner{Vec3(-o, -o, 0), Vec3(o, -o, 0), Vec3(o, o, 0), Vec3(-o, o, 0)};
    const Vec3 up(0, 0, height);
    MeshByHand mesh;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        add_quad(mesh, low[k], low[next], low[next] + up, low[k] + up);
        if (hole > 0) add_quad(mesh, low[next], low[k], inner[k], inner[next]);
    }
    if (hole == 0) add_quad(mesh, low[3], low[2], low[1], low[0]);
    if (lid) add_quad(mesh, low[0] + up, low[1] + up, low[2] + up, low[3] + up);
    return mesh;
}

inline std::string stl_text(const MeshByHand& mesh) {
    std::string text = "solid made by hand\n";
    for (const TriangleByHand& triangle : mesh) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const Vec3& v : triangle) text += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
}

// A folder with scenes and meshes.
class MeshScenes : public test::TemporaryFolder {
  public:
    using TemporaryFolder::write;
    std::filesystem::path write(const std::string& name, const MeshByHand& mesh) const {
        return write(name, stl_text(mesh));
    }
    Scene read(const std::string& text, const Assignments& sets = {}) const {
        return read_scene_text(text, path() / "scene.toml", sets);
    }
    // The reader's message for a scene, without the test's folder; "none" if the scene is right.
    std::string complaint(const std::string& text, const Assignments& sets = {}) const {
        try {
            read(text, sets);
        } catch (const UserError& error) {
            std::string what = error.what();
            const std::string folder = path().string() + "/";
            for (std::size_t at; (at = what.find(folder)) != std::string::npos;)
                what.erase(at, folder.size());
            return what;
        }
        return "none";
    }
};

// A ball above a plate from a file, in the smallest scene that has a mesh.
inline const std::string ball_on_plate = test::SmallScene()
                                             .beads(0, "ball", "10 mm")
                                             .contacts("0.8", "0.3")
                                             .empty_space()
                                             .more("[[mesh]]\nname = \"plate\"\nfile = \"plate.stl\"\n")
                                             .more("[[grain]]\nposition = [0, 0, \"7 mm\"]\n")
                                             .lasts("0.2 s")
                                             .text();

// Grains in a vessel from a file.
inline const std::string in_vessel =
    test::SmallScene()
        .beads(10, "small", "5 mm")
        .beads(2, "big", "10 mm")
        .contacts("0.8", "0.3")
        .more("[container]\nshape = \"mesh\"\nmesh = \"tank\"\n[[mesh]]\nname = \"tank\"\n")
        .more("file = \"tank.stl\"\n")
        .lasts("0.2 s")
        .text();

}  // namespace grainreel
