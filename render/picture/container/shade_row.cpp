// The hot loop that darkens a row of pixels by a map (ground.hpp), compiled for each instruction set.
#include "render/picture/container/ground.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/container/shade_row.cpp"
#include "engine/vector/targets.hpp"
//
#include "render/picture/spheres/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

using F = hn::CappedTag<float, 16>;
using I = hn::RebindToSigned<F>;
using Pixels = hn::RebindToUnsigned<F>;
using V = hn::Vec<F>;
constexpr std::size_t kAtOnce = hn::MaxLanes(F());

// A place along one axis: the cell before it, and how far it lies on the way to the next one.
struct Between {
    hn::Vec<I> cell;
    V on;
};
HWY_INLINE Between between(V at, int side) {
    const F d;
    // Places beside the map are moved to its clear rim. (NaN becomes 0.)
    const V inside = hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, static_cast<float>(side) - 1.0001f));
    const auto cell = hn::ConvertTo(I(), inside);
    return {cell, hn::Sub(inside, hn::ConvertTo(d, cell))};
}

// There are four loads a pixel. A gather takes as long, and much longer on processors that are protected
// against Gather Data Sampling.
HWY_INLINE V strength(const ShadeMap& map, const Between& u, const Between& v) {
    const F d;
    const auto first = hn::Add(hn::Mul(v.cell, hn::Set(I(), map.side)), u.cell);
    alignas(64) std::int32_t at[kAtOnce];
    alignas(64) float corner[4][kAtOnce];
    hn::Store(first, I(), at);
    for (std::size_t i = 0; i < kAtOnce; ++i) {
        const float* cell = map.cells + at[i];
        corner[0][i] = cell[0];
        corner[1][i] = cell[1];
        corner[2][i] = cell[map.side];
        corner[3][i] = cell[map.side + 1];
    }
    const auto mix = [](V a, V b, V share) { return hn::MulAdd(share, hn::Sub(b, a), a); };
    return mix(mix(hn::Load(d, corner[0]), hn::Load(d, corner[1]), u.on),
               mix(hn::Load(d, corner[2]), hn::Load(d, corner[3]), u.on), v.on);
}

HWY_INLINE V place(const MapWalk& walk, int axis, V pixel) {
    const F d;
    return hn::MulAdd(pixel, hn::Set(d, walk.step[axis]), hn::Set(d, walk.first[axis]));
}

void shade(const ShadeMap& map, const MapWalk& walk, const float* across, float all, std::uint32_t* pixels,
           int count) {
    const F d;
    const Pixels p;
    constexpr int lanes = static_cast<int>(kAtOnce);
    for (int x = 0; x < count; x += lanes) {
        const int left = count - x;
        alignas(64) float margin[kAtOnce] = {};
        alignas(64) std::uint32_t below[kAtOnce] = {};
        const bool whole = left >= lanes;
        if (!whole) {
            for (int i = 0; i < left; ++i) margin[i] = across[x + i], below[i] = pixels[x + i];
        }
        const V pixel = hn::Add(hn::Iota(d, 0.0f), hn::Set(d, static_cast<float>(x)));
        const V inverse = hn::Div(hn::Set(d, 1.0f), place(walk, 2, pixel));
        const Between u = between(hn::Mul(place(walk, 0, pixel), inverse), map.side);
        const Between v = between(hn::Mul(place(walk, 1, pixel), inverse), map.side);
        const V faded = hn::Mul(hn::LoadU(d, whole ? across + x : margin), hn::Set(d, all));
        const auto dark =
            hn::BitCast(p, hn::ConvertTo(I(), hn::MulAdd(strength(map, u, v), faded, hn::Set(d, 0.5f))));
        if (hn::AllTrue(p, hn::Eq(dark, hn::Zero(p)))) continue;
        std::uint32_t* to = whole ? pixels + x : below;
        hn::StoreU(over_all(p, hn::ShiftLeft<24>(dark), hn::LoadU(p, to)), p, to);
        if (!whole) {
            for (int i = 0; i < left; ++i) pixels[x + i] = below[i];
        }
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(shade);

void shade_row(const ShadeMap& map, const MapWalk& walk, const float* across, float all,
               std::uint32_t* pixels, int count) {
    HWY_DYNAMIC_DISPATCH(shade)(map, walk, across, all, pixels, count);
}

}  // namespace grainreel
#endif
