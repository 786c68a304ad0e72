// A scene of fifty grains that packs and shakes within a second or so.
#pragma once

#include <filesystem>
#include <fstream>

namespace grainreel::test {

inline constexpr const char* small_scene_text = R"(title = "Fifty grains"
[[species]]
name = "small"
count = 40
diameter = "4 mm"
density = "2.5 g/cm3"
[[species]]
name = "big"
count = 10
diameter = "6 mm"
density = "2.5 g/cm3"
[contact]
restitution = 0.7
friction = 0.4
[container]
shape = "box"
width = "30 mm"
depth = "20 mm"
height = "40 mm"
[drive]
frequency = "20 Hz"
g_level = 2
[run]
duration = "0.2 s"
overlap = 0.05
[film]
size = "160x120"
rate = 30
[[film.segment]]
playback = 0.5
)";

// All grains come while the run goes on.
inline constexpr const char* fed_scene_text = R"([[species]]
name = "glass"
diameter = "4 mm"
density = "2.5 g/cm3"
[container]
shape = "box"
width = "40 mm"
depth = "20 mm"
height = "80 mm"
[start]
method = "rain"
[[feed]]
rate = "200 1/s"
[run]
duration = "0.2 s"
)";

inline std::filesystem::path write_small_scene(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "fifty.toml";
    std::ofstream(path) << small_scene_text;
    return path;
}

}  // namespace grainreel::test
