#include "engine/step/neighbours.hpp"

#include <algorithm>

namespace grainreel {

namespace {

double largest_radius(const Grains& grains) {
    double largest = 0;
    for (const Place& p : grains.place) largest = std::max(largest, p.radius);
    return largest;
}

}  // namespace

const std::vector<std::int32_t>& spatial_order(Cells& cells, Grains& grains, double skin, double period) {
    if (period > 0) {
        for (Place& p : grains.place) p.position.x() = nearest_image(p.position.x(), period);
    }
    cells.lay(grains.place, 2 * largest_radius(grains) + skin, period);
    return cells.order();
}

void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, NeighbourList& list) {
    const std::int32_t n = static_cast<std::int32_t>(grains.size());
    list.start.resize(n + 1);
    list.partner.clear();
    std::array<Cells::Range, 14> ranges;
    for (std::int32_t i = 0; i < n; ++i) {
        list.start[i] = static_cast<std::int32_t>(list.partner.size());
        const Place& me = grains.place[i];
        const int count = cells.partners_after(me.position, i, ranges);
        const double reach = me.radius + skin;
        for (int r = 0; r < count; ++r) {
            for (std::int32_t j = ranges[r].first; j < ranges[r].last; ++j) {
                const Place& other = grains.place[j];
                Vec3 apart = other.position - me.position;
                apart.x() = nearest_image(apart.x(), period);
                const double limit = reach + other.radius;
                if (apart.squaredNorm() < limit * limit) list.partner.push_back(j);
            }
        }
    }
    list.start[n] = static_cast<std::int32_t>(list.partner.size());
}

std::vector<WallNeighbour> list_wall_neighbours(const Grains& grains, const std::vector<Face>& faces,
                                                const Pose& pose, double skin) {
    std::vector<WallNeighbour> list;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Place& p = grains.place[i];
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const Vec3 offset = faces[f].moves ? pose.offset : Vec3::Zero();
            if (distance_to(faces[f], offset, p.position).distance < p.radius + skin) {
                list.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(f)});
            }
        }
    }
    return list;
}

}  // namespace grainreel
