// Fetches data before it is needed, for beds larger than the caches.
//
// Such beds wait for the second bodies of contacts. These lie far from the first ones, in no order that the
// processor could foresee. So all grains are brought to the second-level cache in their order, some time
// before a contact needs them. Second bodies are brought to the first level one chunk ahead.
//
// What this gains: a fifth of the time of a million grains. Small beds would lose by it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/base/system/processor.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/lists/contact_table.hpp"

namespace grainreel {

inline bool is_large_bed(const Grains& grains) {
    return grains.size() >= kLargeBed;
}

// Fetches the places of the second bodies of the candidates in the chunk after the one at c. (It is inlined
// by force, like Ahead::fetch_some().)
[[gnu::always_inline]] inline void fetch_places(const Grains& grains, const ContactTable& table,
                                                std::int32_t c) {
    const std::int32_t begin = std::min(table.candidates(), c + kChunk);
    const std::int32_t end = std::min(table.candidates(), c + 2 * kChunk);
    for (std::int32_t k = begin; k < end; ++k) __builtin_prefetch(&grains.place[table.near_second()[k]]);
}

// Fetches the second bodies of the contacts in the chunk after the one at c. With `rounded`, their motion is
// fetched in the form that mixed precision reads.
[[gnu::always_inline]] inline void fetch_second(const Grains& grains, bool rounded, const ContactTable& table,
                                                std::int32_t c) {
    for (std::int32_t k = c + kChunk; k < std::min(table.sorted(), c + 2 * kChunk); ++k) {
        const std::int32_t j = table.second()[k];
        __builtin_prefetch(&grains.place[j]);
        if (rounded)
            __builtin_prefetch(&grains.rounded[j]);
        else
            __builtin_prefetch(&grains.motion[j]);
        __builtin_prefetch(&grains.load[j], 1);
    }
}

// Fetches second bodies now, and puts into `ahead` the grains that later chunks will need. The present chunk
// has `count` contacts from c on. Where contacts are few, a chunk's grains come from a long stretch, and
// nothing is put into `ahead`: the grains that begin their next step then pass one after the other, and the
// processor fetches them as well by itself.
inline void look_ahead(const Grains& grains, bool rounded, const ContactTable& table, std::int32_t c,
                       int count, Ahead& ahead) {
    constexpr std::int32_t kAhead = 1000, kMost = 300;  // grains; a tile of boxes has some 2,000
    fetch_second(grains, rounded, table, c);
    const auto later = [&](std::int32_t i) {
        return std::min(i + kAhead, static_cast<std::int32_t>(grains.size()));
    };
    const std::int32_t begin = later(table.first()[c]), end = later(table.first()[c + count - 1] + 1);
    ahead.start(rounded ? 28 : 44);  // calls of fetch_some() for one chunk, in all sweeps together
    if (end - begin > kMost) return;
    ahead.add(grains.place, begin, end);
    ahead.add(grains.motion, begin, end);
    ahead.add(grains.load, begin, end);
    if (rounded) ahead.add(grains.rounded, begin, end);
}

}  // namespace grainreel
