// A scene with walls from files: a ball falls on a plate beside a paddle that turns.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/small_scene.hpp"

namespace grainreel::test {

// A square of side 0.2 m at z = 0 that faces up; the unit is m.
inline constexpr const char* plate_stl = R"(solid plate
facet normal 0 0 1
outer loop
vertex -0.1 -0.1 0
vertex 0.1 -0.1 0
vertex 0.1 0.1 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -0.1 -0.1 0
vertex 0.1 0.1 0
vertex -0.1 0.1 0
endloop
endfacet
endsolid plate
)";

// The same square as OBJ in mm, with a triangle that is there twice and one without area.
inline constexpr const char* plate_obj = R"(v -100 -100 0
v 100 -100 0
v 100 100 0
v -100 100 0
f 1 2 3
f 1 3 4
f 2 3 1
f 1 2 2
)";

inline const std::string mesh_scene_text = shared_scene("plate");

inline std::filesystem::path write_mesh_scene(const std::filesystem::path& folder,
                                              const std::string& text = mesh_scene_text) {
    std::ofstream(folder / "plate.stl") << plate_stl;
    std::ofstream(folder / "plate.obj") << plate_obj;
    const std::filesystem::path path = folder / "plate.toml";
    std::ofstream(path) << text;
    return path;
}

}  // namespace grainreel::test
