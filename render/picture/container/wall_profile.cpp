#include "render/picture/container/wall_profile.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture/container/container_drawing.hpp"

namespace grainreel {

WallProfile wall_profile(const Container& container, double side) {
    const double t = drawn_thickness(container), top = container.height;
    WallProfile profile;
    const auto add = [&](double inner, double z, double outer, double outer_z) {
        profile.inner.emplace_back(side * inner, z);
        profile.outer.emplace_back(side * outer, outer_z);
    };
    const double angle = container.shape == Container::Shape::wedge ? container.half_angle : 0;
    const double bend = angle > 0 ? std::min(container.slant_height, top) : 0;
    if (bend > 0) add(container.half_width_at(0), 0, container.half_width_at(0) + t / std::cos(angle), 0);
    if (bend > 0 && bend < top)
        add(container.half_width, bend, container.half_width + t, bend - t * std::tan(0.5 * angle));
    if (bend <= 0) add(container.half_width, 0, container.half_width + t, 0);
    const double slant = bend >= top ? t / std::cos(angle) : t;
    add(container.half_width_at(top), top, container.half_width_at(top) + slant, top);
    return profile;
}

}  // namespace grainreel
