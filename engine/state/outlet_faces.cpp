#include "engine/state/outlet_faces.hpp"

#include <cmath>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

// m: as wide as a gap that leaves nothing of the floor. Then the walls' lower edges are those of the outlet.
constexpr double kNoFloorLeft = 1e9;
// Relative: of the floor that rounding leaves where the scene says the same width twice.
constexpr double kRounding = 1e-9;

void open_floor(const Container& container, Face& floor) {
    const Outlet& outlet = *container.outlet;
    const bool hole = outlet.shape == Outlet::Shape::hole;
    floor.ends = true;
    floor.round_gap = hole;
    floor.gap = outlet.half_width;
    const bool round = container.shape == Container::Shape::cylinder;
    if (hole == round && outlet.half_width >= (1 - kRounding) * container.floor_half_width())
        floor.gap = kNoFloorLeft;
}

// Vertical walls end at the floor, those of a wedge where the slants begin, and the slants at the floor.
void end_wall(const Container& container, Face& wall) {
    wall.ends = true;
    wall.along = Vec3(0, 0, 1);
    wall.edge = wall.point;
    if (wall.kind == Face::Kind::cylinder || container.shape != Container::Shape::wedge) return;
    const double side = wall.normal.y() < 0 ? 1 : -1;
    if (wall.normal.z() > 0) {
        wall.along = Vec3(0, side * std::sin(container.half_angle), std::cos(container.half_angle));
        wall.edge = Vec3(0, side * container.floor_half_width(), 0);
    } else if (wall.normal.y() != 0) {
        wall.edge.z() = container.slant_height;
    }
}

}  // namespace

void open_outlet(const Container& container, std::vector<Face>& faces) {
    GRAINREEL_CHECK(container.outlet);
    for (Face& face : faces) {
        if (face.body.number == kFloorBody)
            open_floor(container, face);
        else if (face.body.number == kContainerBody && face.normal.z() >= 0)  // the lid stays whole
            end_wall(container, face);
    }
}

}  // namespace grainreel
