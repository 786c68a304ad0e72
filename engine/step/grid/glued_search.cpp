#include "engine/step/grid/glued_search.hpp"

#include <algorithm>

namespace grainreel {

GluedSearch::GluedSearch(const GluedGrains& glued, const std::vector<Face>& faces, double period)
    : glued_(glued), period_(period) {
    std::vector<std::vector<std::int32_t>> members;  // by part
    for (std::size_t g = 0; g < glued.size(); ++g) {
        const Body& body = faces[static_cast<std::size_t>(glued.face[g])].body;
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
        GridFrame frame;
        frame.low = frame.high = at_rest_[static_cast<std::size_t>(members[part][0])].position;
        for (const std::int32_t g : members[part]) {
            frame.low = frame.low.cwiseMin(at_rest_[static_cast<std::size_t>(g)].position);
            frame.high = frame.high.cwiseMax(at_rest_[static_cast<std::size_t>(g)].position);
        }
        if (period > 0) frame.low.x() = -0.5 * period, frame.high.x() = 0.5 * period;
        frame.grains = members[part].size();
        frame.period = period;
        parts_[part].grid.lay(at_rest_, members[part], 2 * largest_, frame);
    }
}

void GluedSearch::list(const Grains& grains, const Pose& pose, double skin, std::int32_t begin,
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

}  // namespace grainreel
