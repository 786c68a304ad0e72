#include "engine/step/grid/neighbours.hpp"

#include <algorithm>
#include <cstring>

#include "engine/mesh/surface.hpp"

namespace grainreel {

void put_in_order(const TeamMember& me, Cells& cells, Grains& grains, double skin, double period,
                  std::vector<std::int32_t>& index) {
    if (me.leads()) {
        if (period > 0) {
            for (Place& p : grains.place) p.position.x() = nearest_image(p.position.x(), period);
        }
        cells.order(grains.place, skin, period);
        index.resize(grains.size());
    }
    me.wait();
    const std::vector<std::int32_t>& order = cells.in_order();
    grains.reorder(order, me);
    const auto [begin, end] = me.part_of(order.size());
    for (std::int32_t i = begin; i < end; ++i) index[order[i]] = i;
    me.wait();
    if (me.leads()) cells.lay(grains.place, skin);
    me.wait();
}

void NeighbourList::put(const NeighbourList& part, std::size_t grain, std::size_t at) {
    const auto shift = static_cast<std::int32_t>(at);
    for (std::size_t i = 1; i < part.start.size(); ++i) start[grain + i] = part.start[i] + shift;
    std::copy(part.partner.begin(), part.partner.end(), partner.begin() + static_cast<std::ptrdiff_t>(at));
}

namespace {

void make_room(std::vector<std::int32_t>& partner, std::size_t wanted) {
    if (wanted > partner.capacity()) partner.reserve(wanted + wanted / 32 + 1024);
    partner.resize(partner.capacity());
}

// Sorts partners that come from several grids, tiles, or both ends of a period. The code that merges lists
// relies on this order.
void in_order(std::vector<std::int32_t>& partner, std::size_t from, std::size_t to) {
    const auto begin = partner.begin() + static_cast<std::ptrdiff_t>(from);
    const auto end = partner.begin() + static_cast<std::ptrdiff_t>(to);
    if (!std::is_sorted(begin, end)) std::sort(begin, end);
}

// Copies [first, last) of an array that ends at `end`. It first copies a block of constant length, which is
// mostly enough. A mere loop would be slower, because the processor cannot predict how many grains a row of
// boxes holds. It may write up to kNearSlack places after the copy.
void copy_row(const std::int32_t* first, const std::int32_t* last, const std::int32_t* end,
              std::int32_t* to) {
    if (end - first < kNearSlack) {
        std::copy(first, last, to);
        return;
    }
    std::memcpy(to, first, kNearSlack * sizeof *to);
    if (last - first > kNearSlack) std::copy(first + kNearSlack, last, to + kNearSlack);
}

}  // namespace

void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part) {
    part.start.resize(end - begin + 1);
    std::vector<std::int32_t>& partner = part.partner;
    std::size_t count = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        part.start[i - begin] = static_cast<std::int32_t>(count);
        const Place& own = grains.place[i];
        std::size_t candidates = count;
        int turns = 0;  // stretches of rising indices
        for (const Cells::Level& level : cells.levels()) {
            const std::size_t before = candidates;
            const std::int32_t* const end_of_rows = level.grid.in_order().data() + level.members.size();
            level.grid.near(own.position, own.radius + skin + level.largest, level.leads,
                            [&](const std::int32_t* first, const std::int32_t* last) {
                                if (level.rising && last[-1] <= i) return;
                                const std::size_t more = candidates + (last - first);
                                if (partner.size() < more + kNearSlack) make_room(partner, more + kNearSlack);
                                copy_row(first, last, end_of_rows, partner.data() + candidates);
                                candidates = more;
                            });
            if (candidates > before) turns += level.rising && level.grid.is_one_tile() && period == 0 ? 1 : 2;
        }
        const std::size_t from = count;
        if (candidates > count)
            count += keep_near(grains, i, skin, period, partner.data() + count,
                               static_cast<std::int32_t>(candidates - count));
        if (turns > 1) in_order(partner, from, count);
    }
    part.start[end - begin] = static_cast<std::int32_t>(count);
    part.partner.resize(count);
    part.farthest_partner = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        const std::int32_t behind = part.start[i - begin + 1];
        if (part.start[i - begin] < behind)
            part.farthest_partner = std::max(part.farthest_partner, part.partner[behind - 1] - i);
    }
}

void list_walls(const Grains& grains, const std::vector<Face>& faces, const DrivePose& pose, double skin,
                std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part) {
    part.clear();
    for (std::int32_t i = begin; i < end; ++i) {
        const Place& p = grains.place[i];
        for (std::size_t f = 0; f < faces.size(); ++f) {
            if (distance_at(faces[f], pose, p.position).distance < p.radius + skin)
                part.push_back({i, static_cast<std::int32_t>(f)});
        }
    }
}

GluedSearch::GluedSearch(const GluedGrains& glued, const std::vector<Face>& faces, double period)
    : period_(period) {
    std::vector<std::vector<std::int32_t>> members;  // one for each part
    for (std::size_t g = 0; g < glued.size(); ++g) {
        const Body& body = faces[glued.face[g]].body;
        at_rest_.push_back({glued.centre(g, faces, {}), glued.place[g].radius});
        at_rest_.back().position.x() = wrapped(at_rest_.back().position.x(), period);
        largest_ = std::max(largest_, glued.place[g].radius);
        const auto found = std::find_if(parts_.begin(), parts_.end(),
                                        [&](const OfBody& part) { return part.body.number == body.number; });
        const auto part = static_cast<std::size_t>(found - parts_.begin());
        if (found == parts_.end()) parts_.push_back({body, {}}), members.emplace_back();
        members[part].push_back(static_cast<std::int32_t>(g));
    }
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        GridLayout frame;
        frame.low = frame.high = at_rest_[members[part][0]].position;
        for (const std::int32_t g : members[part]) {
            frame.low = frame.low.cwiseMin(at_rest_[g].position);
            frame.high = frame.high.cwiseMax(at_rest_[g].position);
        }
        if (period > 0) frame.low.x() = -0.5 * period, frame.high.x() = 0.5 * period;
        frame.grains = members[part].size();
        frame.period = period;
        parts_[part].grid.lay(at_rest_, members[part], 2 * largest_, frame);
    }
}

void GluedSearch::list(const Grains& grains, const DrivePose& pose, double skin, std::int32_t begin,
                       std::int32_t end, std::vector<WallNeighbour>& part) const {
    part.clear();
    if (parts_.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        const Place& own = grains.place[i];
        const std::size_t from = part.size();
        near(own.position, own.radius + skin, pose, [&](std::int32_t g, double) { part.push_back({i, g}); });
        std::sort(part.begin() + static_cast<std::ptrdiff_t>(from), part.end(),
                  [](const WallNeighbour& a, const WallNeighbour& b) { return a.face < b.face; });
    }
}

namespace {

// Finds the meshes near grains. Successive grains lie near each other, so one search can show that a mesh is
// far from many grains at once.
class MeshSearch {
  public:
    MeshSearch(const Grains& grains, double skin, std::vector<WallNeighbour>& part)
        : grains_(grains), skin_(skin), part_(part) {}

    void list(const Surface& surface, std::int32_t mesh, const BodyPose& pose, std::int32_t begin,
              std::int32_t end) {
        if (end - begin <= kFew) {
            for (std::int32_t i = begin; i < end; ++i) {
                const Place& own = grains_.place[i];
                if (surface.any_within(pose.at_rest(own.position), own.radius + skin_))
                    part_.push_back({i, mesh});
            }
            return;
        }
        Eigen::AlignedBox3d centres;
        double largest = 0;
        for (std::int32_t i = begin; i < end; ++i) {
            centres.extend(grains_.place[i].position);
            largest = std::max(largest, grains_.place[i].radius);
        }
        const double reach = 0.5 * centres.sizes().norm() + largest + skin_;
        if (!surface.any_within(pose.at_rest(centres.center()), kMore * reach)) return;
        const std::int32_t half = begin + (end - begin) / 2;
        list(surface, mesh, pose, begin, half);
        list(surface, mesh, pose, half, end);
    }

  private:
    static constexpr std::int32_t kFew = 4;    // grains; so few are searched for one by one
    static constexpr double kMore = 1 + 1e-6;  // room for rounding, even far from the origin

    const Grains& grains_;
    double skin_;
    std::vector<WallNeighbour>& part_;
};

}  // namespace

void list_meshes(const Grains& grains, const std::vector<MeshWall>& meshes, const DrivePose& pose,
                 double skin, std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part) {
    part.clear();
    MeshSearch search(grains, skin, part);
    for (std::size_t m = 0; m < meshes.size(); ++m)
        search.list(*meshes[m].surface, static_cast<std::int32_t>(m), meshes[m].body.at(pose), begin, end);
    if (meshes.size() < 2) return;
    std::sort(part.begin(), part.end(), [](const WallNeighbour& a, const WallNeighbour& b) {
        return a.grain != b.grain ? a.grain < b.grain : a.face < b.face;
    });
}

}  // namespace grainreel
