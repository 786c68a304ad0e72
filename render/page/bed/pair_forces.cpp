#include "render/page/bed/pair_forces.hpp"

#include <algorithm>

#include "render/page/bed/bed_frames.hpp"
#include "render/page/embed.hpp"

namespace grainreel {
namespace {

constexpr std::uint32_t most_bodies = 0xffffff;

// Bytes of numbers below 2^24, plane by plane.
void append_planes(std::vector<std::uint8_t>& bytes, const std::vector<std::uint32_t>& numbers) {
    for (const int shift : {0, 8, 16})
        for (const std::uint32_t number : numbers)
            bytes.push_back(static_cast<std::uint8_t>((number >> shift) & 0xff));
}

}  // namespace

void PairForcesWriter::add(std::size_t moment, const std::vector<Touch>& touches,
                           const std::map<std::int32_t, std::size_t>& slots) {
    std::vector<Pair> pairs;
    for (const Touch& touch : touches) {
        if (!(touch.force > 0)) continue;
        const auto first = slots.find(touch.first), second = slots.find(touch.second);
        if (first == slots.end() || (second == slots.end() && touch.second >= 0)) continue;
        const std::uint32_t other = touch.second >= 0
                                        ? static_cast<std::uint32_t>(second->second)
                                        : most_bodies - static_cast<std::uint32_t>(-1 - touch.second);
        pairs.push_back({static_cast<std::uint32_t>(first->second), other, touch.force});
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.first < b.first; });
    moments_.push_back({moment, pairs.size()});
    pairs_.push_back(std::move(pairs));
}

PairForces PairForcesWriter::written() const {
    PairForces forces;
    forces.moments = moments_;
    for (const auto& pairs : pairs_)
        for (const Pair& pair : pairs) forces.highest = std::max(forces.highest, pair.force);
    forces.lowest = forces.highest / kByteSpan;
    std::vector<std::uint8_t> bytes;
    for (const auto& pairs : pairs_) {
        std::vector<std::uint32_t> firsts, seconds;
        std::uint32_t before = 0;
        for (const Pair& pair : pairs) {
            firsts.push_back(pair.first - before);
            seconds.push_back(pair.second);
            before = pair.first;
        }
        append_planes(bytes, firsts);
        append_planes(bytes, seconds);
        for (const Pair& pair : pairs) bytes.push_back(speed_byte(pair.force, forces.lowest, forces.highest));
    }
    if (!moments_.empty()) forces.packed = zlib_packed(bytes);
    return forces;
}

}  // namespace grainreel
