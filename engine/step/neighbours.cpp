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

void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part) {
    part.start.resize(end - begin + 1);
    std::size_t count = 0;
    std::int32_t farthest = 0;
    std::array<Cells::Range, 14> ranges;
    const Place* place = grains.place.data();
    for (std::int32_t i = begin; i < end; ++i) {
        part.start[i - begin] = static_cast<std::int32_t>(count);
        const Vec3 centre = place[i].position;
        const double reach = place[i].radius + skin;
        const int found = cells.partners_after(centre, i, ranges);
        for (int r = 0; r < found; ++r) {
            const auto [first, last] = ranges[r];
            if (part.partner.size() < count + (last - first))
                part.partner.resize(2 * count + 64 + (last - first));
            // Every candidate is written and the hits are kept: no branch to mispredict.
            std::int32_t* next = part.partner.data() + count;
            for (std::int32_t j = first; j < last; ++j) {
                Vec3 apart = place[j].position - centre;
                apart.x() = nearest_image(apart.x(), period);
                const double limit = reach + place[j].radius;
                *next = j;
                next += apart.squaredNorm() < limit * limit;
            }
            count = next - part.partner.data();
            farthest = std::max(farthest, last - 1 - i);
        }
    }
    part.start[end - begin] = static_cast<std::int32_t>(count);
    part.farthest_partner = farthest;
    part.partner.resize(count);
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

std::vector<WallNeighbour> list_wall_neighbours(const Grains& grains, const std::vector<Face>& faces,
                                                const Pose& pose, double skin) {
    std::vector<WallNeighbour> list;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Place& p = grains.place[i];
        for (std::size_t f = 0; f < faces.size(); ++f) {
            if (distance_to(faces[f], faces[f].displacement(pose), p.position).distance < p.radius + skin) {
                list.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(f)});
            }
        }
    }
    return list;
}

}  // namespace grainreel
