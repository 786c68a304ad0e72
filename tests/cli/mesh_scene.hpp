// A scene with walls from files: a ball falls on a plate beside a paddle that turns.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

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

inline constexpr const char* mesh_scene_text = R"(title = "A ball on a plate from a file"
[[species]]
name = "ball"
diameter = "10 mm"
density = "2.5 g/cm3"
[contact]
restitution = 0.8
friction = 0.3
[container]
shape = "none"
[[mesh]]
name = "plate"
file = "plate.stl"
[[mesh]]
name = "paddle"
file = "plate.obj"
scale = 0.001
position = [0, 0, "15 mm"]
turn = { axis = [0, 0, 1], through = [0, 0, 0], rate = "30 rpm", from = "10 ms", over = "20 ms" }
[[grain]]
position = ["10 mm", "20 mm", "7 mm"]
[run]
duration = "0.1 s"
[film]
size = "160x120"
)";

inline std::filesystem::path write_mesh_scene(const std::filesystem::path& folder,
                                              const std::string& text = mesh_scene_text) {
    std::ofstream(folder / "plate.stl") << plate_stl;
    std::ofstream(folder / "plate.obj") << plate_obj;
    const std::filesystem::path path = folder / "plate.toml";
    std::ofstream(path) << text;
    return path;
}

}  // namespace grainreel::test
