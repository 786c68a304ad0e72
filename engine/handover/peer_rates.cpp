#include "engine/handover/peer_rates.hpp"

#include <algorithm>

namespace grainreel {

PeerRate rate_of(PeerEngine engine) {
    if (engine == PeerEngine::lammps) return {4.0e6, 3.1e6, 2100};
    return {7.0e6, 6.7e6, 1400};
}

std::int64_t useful_ranks(std::int64_t grains) {
    return std::max<std::int64_t>(1, grains / 5000);
}

double peer_seconds(PeerEngine engine, RunFrame frame, std::int64_t grains, std::int64_t steps, int ranks) {
    const PeerRate rate = rate_of(engine);
    const double one = frame == RunFrame::container ? rate.standing : rate.moving;
    const double together = ranks > 1 ? 0.8 * ranks : 1;
    return static_cast<double>(grains) * static_cast<double>(steps) / (one * together);
}

double peer_bytes(PeerEngine engine, std::int64_t grains) {
    return rate_of(engine).bytes_a_grain * static_cast<double>(grains);
}

}  // namespace grainreel
