#include "render/picture/spheres/edge_candidates.hpp"

#include <algorithm>

namespace grainreel {
namespace {

constexpr ViewSphere kNobody{0, 0, 1, -1};

}  // namespace

void take_candidates(const Visibility& visibility, const std::vector<ViewSphere>& spheres, int x, int y,
                     EdgeBlock& block, std::uint32_t (&who)[kCandidates][kPointBlock], int at) {
    const std::uint32_t* row = visibility.row(y);
    const std::uint32_t around[5] = {row[x], row[x - 1], row[x + 1], visibility.row(std::max(0, y - 1))[x],
                                     visibility.row(std::min(y + 1, visibility.height() - 1))[x]};
    int found = 0;
    for (const std::uint32_t number : around) {
        bool is_new = number != 0 && found < kCandidates;
        for (int c = 0; c < found && is_new; ++c) is_new = who[c][at] != number - 1;
        if (!is_new) continue;
        who[found][at] = number - 1;
        block.candidate[found++][at] = spheres[number - 1];
    }
    for (int c = found; c < kCandidates; ++c) block.candidate[c][at] = kNobody;
    block.candidates = at == 0 ? found : std::max(block.candidates, found);
    block.x[at] = static_cast<float>(x) + 0.5f;
    block.y[at] = static_cast<float>(y) + 0.5f;
}

void clear_candidates(EdgeBlock& block, int begin) {
    for (int i = begin; i < kPointBlock; ++i) {
        block.x[i] = block.y[i] = 0;
        for (auto& candidate : block.candidate) candidate[i] = kNobody;
    }
}

}  // namespace grainreel
