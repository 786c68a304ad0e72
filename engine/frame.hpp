// What leaves the engine: the state of every grain and of the container at one step. Neutral: no laws in it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

struct Frame {
    std::int64_t step = 0;
    double time = 0;    // s since the drive started, negative before
    double cycles = 0;  // periods since the drive started
    double phase = 0;   // turns in [0, 1)

    // Where walls and floor are, against their rest position; m and m/s.
    Vec3 wall_offset{0, 0, 0}, wall_velocity{0, 0, 0};
    Vec3 floor_offset{0, 0, 0}, floor_velocity{0, 0, 0};

    // One entry a grain, in order of id. SI units.
    std::vector<std::int32_t> id;
    std::vector<std::int32_t> species;
    std::vector<double> radius;
    std::vector<Vec3> position, velocity, spin;
    std::vector<Quaternion> orientation;  // empty unless the scene asks for it

    std::size_t size() const { return id.size(); }
};

using FramePtr = std::shared_ptr<const Frame>;

}  // namespace grainreel
