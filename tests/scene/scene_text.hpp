// Small scenes for the tests of reader, plan and writer.
#pragma once

#include <string>

#include "engine/measure/columns.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

inline const std::string wedge_text = R"(title = "test"
gravity = 10.0
[[species]]
name = "small"
count = 100
diameter = "5 mm"
density = 2500
[[species]]
name = "big"
count = 10
diameter = "10 mm"
density = 2500
[contact]
restitution = 0.8
friction = 0.3
[container]
shape = "wedge"
half_angle = "20 deg"
slant_height = "70 mm"
half_width = "55 mm"
depth = "45 mm"
height = "180 mm"
[drive]
frequency = "20 Hz"
g_level = 3
[run]
duration = "2 s"
)";

// A scene without drive and gravity: two kinds of grains are in a box, and law and stiffness are given.
inline const std::string box_text = R"(gravity = 0
[[species]]
name = "a"
count = 5
diameter = "1 mm"
density = 2500
[[species]]
name = "b"
count = 5
diameter = "2 mm"
density = 2500
[contact]
law = "spring-dashpot"
stiffness = 1000
normal_damping = 2634
friction = 0.5
[container]
shape = "box"
width = 0.02
depth = 0.02
height = 0.02
top = "open"
[run]
duration = 0.1
)";

// `text` with `from` replaced by `to`; fails the test when `from` is not in it.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    return at == std::string::npos ? throw std::logic_error("no '" + from + "' in the scene")
                                   : text.replace(at, from.size(), to);
}

inline FilmedScene read_text(const std::string& text, const Assignments& sets = {}) {
    return read_filmed_scene_text(text, "test.toml", sets, measurable_in);
}

// A scene with two grains placed by hand in empty space, and a plane that comes nearer.
inline const std::string exact_text = R"(gravity = 0
[[species]]
name = "ball"
diameter = "4 mm"
density = 2500
[contact]
restitution = 0.8
friction = 0.3
[container]
shape = "none"
[[wall]]
point = [0, 0, "-3 mm"]
normal = [0, 0, 2]
velocity = [0, 0, "10 cm/s"]
[[grain]]
position = [0, 0, 0]
velocity = [0, "0.5 m/s", 0]
spin = [0, 0, "60 rad/s"]
[[grain]]
species = "ball"
position = [0, "1 cm", 0]
[run]
duration = "50 ms"
)";

}  // namespace grainreel
