// A scale fixed in the lab beside the container's floor, and a pointer on it that goes with the floor.
#pragma once

#include <vector>

#include "render/picture/container/drawing_kit.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m, from rest to the end of the stroke, as drawn.
Vec3 drawn_stroke(const FilmedScene& scene);

// A long tick where the floor rests and short ones at both ends of its stroke.
struct LabMark {
    Vec3 foot;    // m, where the long tick begins, at rest
    Vec3 along;   // m, its direction and length
    Vec3 stroke;  // m, the displacement at the end of the stroke
};
bool has_lab_marks(const FilmedScene& scene);
// azimuth: degrees, of the camera.
std::vector<LabMark> lab_marks(const FilmedScene& scene, double azimuth);

void draw_lab_marks(const FilmedScene& scene, const Sketches& sketches, double azimuth, WallSide& on);

}  // namespace grainreel
