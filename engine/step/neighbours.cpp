#include "engine/step/neighbours.hpp"

#include <algorithm>

namespace grainreel {

void put_in_order(Cells& cells, Grains& grains, double skin, double period,
                  std::vector<std::int32_t>& index) {
    if (period > 0) {
        for (Place& p : grains.place) p.position.x() = nearest_image(p.position.x(), period);
    }
    const std::vector<std::int32_t>& order = cells.order(grains.place, skin, period);
    grains.reorder(order);
    index.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) index[order[i]] = static_cast<std::int32_t>(i);
    cells.lay(grains.place, skin, period);
}

void NeighbourList::append(const NeighbourList& more) {
    const std::int32_t shift = start.back();
    for (std::size_t i = 1; i < more.start.size(); ++i) start.push_back(more.start[i] + shift);
    partner.insert(partner.end(), more.partner.begin(), more.partner.end());
    farthest_partner = std::max(farthest_partner, more.farthest_partner);
}

namespace {

void make_room(std::vector<std::int32_t>& partner, std::size_t wanted) {
    if (wanted > partner.capacity()) partner.reserve(wanted + wanted / 32 + 1024);
    partner.resize(partner.capacity());
}

}  // namespace

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
                                    make_room(part.partner, count + (last - first));
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
