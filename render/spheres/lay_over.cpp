#include "render/spheres/lay_over.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/spheres/lay_over.cpp"
#include "engine/vector/targets.hpp"
//
#include <hwy/highway.h>

#include "render/spheres/pixel.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Pixels = hn::ScalableTag<std::uint32_t>;
using V = hn::Vec<Pixels>;

HWY_INLINE V scaled_all(V pixels, V share) {
    const Pixels d;
    const V even = hn::Set(d, 0x00ff00ffu), half = hn::Set(d, 0x00800080u);
    const auto pair = [&](V two) {
        const V product = hn::Add(hn::Mul(two, share), half);
        return hn::And(hn::ShiftRight<8>(hn::Add(product, hn::And(hn::ShiftRight<8>(product), even))), even);
    };
    return hn::Add(pair(hn::And(pixels, even)),
                   hn::ShiftLeft<8>(pair(hn::And(hn::ShiftRight<8>(pixels), even))));
}

void lay(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength) {
    const Pixels d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        V above = hn::LoadU(d, top + x);
        if (hn::AllTrue(d, hn::Eq(above, hn::Zero(d)))) continue;
        if (strength != 255) above = scaled_all(above, hn::Set(d, strength));
        const V left = hn::Sub(hn::Set(d, 255), hn::ShiftRight<24>(above));
        hn::StoreU(hn::Add(above, scaled_all(hn::LoadU(d, below + x), left)), d, below + x);
    }
    for (; x < count; ++x) below[x] = over(scaled(top[x], strength), below[x]);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(lay);

void lay_over(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength) {
    HWY_DYNAMIC_DISPATCH(lay)(below, top, count, strength);
}

}  // namespace grainreel
#endif
