#include "engine/step/neighbours.hpp"

#include <algorithm>

namespace grainreel {

const std::vector<std::int32_t>& put_in_order(Cells& cells, Grains& grains, double skin, double period) {
    if (period > 0) {
        for (Place& p : grains.place) p.position.x() = nearest_image(p.position.x(), period);
    }
    const std::vector<std::int32_t>& order = cells.order(grains.place, skin, period);
    grains.reorder(order);
    cells.lay(grains.place, skin, period);
    return order;
}

void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part) {
    part.start.resize(end - begin + 1);
    std::size_t count = 0;
    const Place* place = grains.place.data();
    for (std::int32_t i = begin; i < end; ++i) {
        part.start[i - begin] = static_cast<std::int32_t>(count);
        const Vec3 centre = place[i].position;
        const double reach = place[i].radius + skin;
        for (const Cells::Level& level : cells.levels()) {
            level.grid.near(centre, reach + level.largest,
                            [&](const std::int32_t* first, const std::int32_t* last) {
                                if (level.rising && last[-1] <= i) return;
                                if (part.partner.size() < count + (last - first))
                                    part.partner.resize(2 * count + 64 + (last - first));
                                // Every candidate is written and the hits are kept: no branch to mispredict.
                                std::int32_t* next = part.partner.data() + count;
                                for (; first < last; ++first) {
                                    const std::int32_t j = *first;
                                    Vec3 apart = place[j].position - centre;
                                    apart.x() = nearest_image(apart.x(), period);
                                    const double limit = reach + place[j].radius;
                                    *next = j;
                                    next += (j > i) & (apart.squaredNorm() < limit * limit);
                                }
                                count = next - part.partner.data();
                            });
        }
    }
    part.start[end - begin] = static_cast<std::int32_t>(count);
    part.partner.resize(count);
    part.farthest_partner = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        for (std::int32_t at = part.start[i - begin]; at < part.start[i - begin + 1]; ++at)
            part.farthest_partner = std::max(part.farthest_partner, part.partner[at] - i);
    }
}

void join_lists(const std::vector<const NeighbourList*>& parts, NeighbourList& whole) {
    whole.start.clear();
    whole.partner.clear();
    whole.farthest_partner = 0;
    for (const NeighbourList* each : parts) {
        const NeighbourList& part = *each;
        const std::int32_t shift = static_cast<std::int32_t>(whole.partner.size());
        for (std::size_t i = 0; i + 1 < part.start.size(); ++i) whole.start.push_back(part.start[i] + shift);
        whole.farthest_partner = std::max(whole.farthest_partner, part.farthest_partner);
        whole.partner.insert(whole.partner.end(), part.partner.begin(), part.partner.end());
    }
    whole.start.push_back(static_cast<std::int32_t>(whole.partner.size()));
}

void list_walls(const Grains& grains, const std::vector<Face>& faces, const Pose& pose, double skin,
                std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part) {
    part.clear();
    for (std::int32_t i = begin; i < end; ++i) {
        const Place& p = grains.place[i];
        for (std::size_t f = 0; f < faces.size(); ++f) {
            if (distance_to(faces[f], faces[f].displacement(pose), p.position).distance < p.radius + skin)
                part.push_back({i, static_cast<std::int32_t>(f)});
        }
    }
}

}  // namespace grainreel
