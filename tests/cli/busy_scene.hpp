// A scene of 0.1 s that has everything a resumed run must carry on.
#pragma once

namespace grainreel::test {

// The scene has grains that come and leave, stages of the drive, fields, contacts, instruments and a film.
inline constexpr const char* busy_scene_text = R"(title = "Busy"
[[species]]
name = "big"
count = 4
diameter = "6 mm"
density = "2.5 g/cm3"
[[species]]
name = "small"
count = 12
diameter = { min = "3 mm", max = "4 mm" }
density = "2.5 g/cm3"
[contact]
restitution = 0.6
friction = 0.4
[container]
shape = "box"
width = "30 mm"
depth = "15 mm"
height = "60 mm"
periodic_depth = false
outlet = { width = "14 mm", opens = "0.03 s", exit_depth = "10 mm" }
[[feed]]
species = "small"
rate = 300
[drive]
frequency = "40 Hz"
g_level = 2
ramp = 0
[[drive.stage]]
from = "0.025 s"
frequency = "60 Hz"
over = 3
[start]
settle_limit = "0.01 s"
[run]
duration = "0.1 s"
overlap = 0.05
accuracy = "draft"
threads = 1
[output]
contacts = true
orientation = true
instruments = ["walls", "outflow"]
trajectory_interval = "7 ms"
measures_interval = "3 ms"
[output.fields]
grid = "yz"
periods = 1
samples = 4
width = "4 mm"
cell = "8 mm"
[film]
size = "160x90"
rate = 25
preset = "ultrafast"
[[film.segment]]
playback = 0.5
)";

}  // namespace grainreel::test
