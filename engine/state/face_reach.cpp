#include "engine/state/face_reach.hpp"

#include <algorithm>

namespace grainreel {

void set_reach(const Container& container, std::vector<Face>& faces) {
    if (!container.turn) return;
    const bool round = container.shape == Container::Shape::cylinder;
    const double depth = round ? 2 * container.half_width : container.depth;
    const double top = (container.lid ? 1 : 2) * container.height;
    double reach = 0;
    for (const double x : {-0.5 * depth, 0.5 * depth})
        for (const double y : {-container.half_width, container.half_width})
            for (const double z : {0.0, top}) {
                const Vec3 from = Vec3(x, y, z) - container.turn->through;
                reach = std::max(reach, from.cross(container.turn->axis).norm());
            }
    for (Face& face : faces) face.reach = reach;
}

}  // namespace grainreel
