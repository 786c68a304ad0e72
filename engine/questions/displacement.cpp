#include "engine/questions/displacement.hpp"

#include <limits>

#include "engine/base/numbers.hpp"
#include "engine/questions/rows_in.hpp"

namespace grainreel {

void set_displacement(Frame& now, const Frame& before, int periods, double depth) {
    const std::vector<std::size_t> rows = rows_in(before, now);
    now.displacement.assign(now.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (rows[i] == kNoRow) continue;
        Vec3 way = now.position[i] - before.position[rows[i]];
        way.x() = nearest_image(way.x(), depth);
        now.displacement[i] = way / periods;
    }
}

}  // namespace grainreel
