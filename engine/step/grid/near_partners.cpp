// Sieves the candidates of one grain by distance, a register at once. Hot: each rebuild of the lists calls it
// for every grain.
#include "engine/step/grid/neighbours.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/grid/near_partners.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/grid/places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

std::int32_t near_ones(const Grains& grains, std::int32_t i, double skin, double period,
                       std::int32_t* candidates, std::int32_t count) {
    static_assert(kLanes <= kNearSlack);
    using Indices = hn::Rebind<std::int32_t, Doubles>;
    const double* place = numbers(grains.place);
    const Place& own = grains.place[i];
    const Triple<Lanes> centre{Lanes(own.position.x()), Lanes(own.position.y()), Lanes(own.position.z())};
    const Lanes reach(own.radius + skin), index(static_cast<double>(i));
    for (int c = count; c % kLanes != 0; ++c) candidates[c] = i;  // i is not above itself, so it is not kept
    std::int32_t kept = 0;
    for (int c = 0; c < count; c += kLanes) {
        const auto other = load_bundles(place, sizeof(Place) / sizeof(double), candidates + c);
        Triple<Lanes> apart = triple(other) - centre;
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes limit = reach + Lanes(other.d);
        const auto partners = hn::LoadU(Indices(), candidates + c);
        const Lanes above(hn::PromoteTo(Doubles(), partners));
        // CompressBits() reads eight bytes.
        const std::uint8_t near[8] = {
            static_cast<std::uint8_t>(bits((apart.squared() < limit * limit) & (above > index)))};
        // A whole register is stored, over candidates that have been read already. On Zen 4, storing only
        // some of the lanes takes a hundred cycles.
        hn::StoreU(hn::CompressBits(partners, near), Indices(), candidates + kept);
        kept += std::popcount(near[0]);
    }
    return kept;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(near_ones);

std::int32_t keep_near(const Grains& grains, std::int32_t i, double skin, double period,
                       std::int32_t* candidates, std::int32_t count) {
    return HWY_DYNAMIC_DISPATCH(near_ones)(grains, i, skin, period, candidates, count);
}

}  // namespace grainreel
#endif
