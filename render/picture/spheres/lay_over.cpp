// The hot loop that lays a row of pixels over another (layer.hpp), compiled for each instruction set.
#include "render/picture/spheres/layer.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/spheres/lay_over.cpp"
#include "engine/vector/targets.hpp"
//
#include "render/picture/spheres/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

void lay(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength) {
    const hn::ScalableTag<std::uint32_t> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        auto above = hn::LoadU(d, top + x);
        if (hn::AllTrue(d, hn::Eq(above, hn::Zero(d)))) continue;
        if (strength != 255) above = scaled_all(d, above, hn::Set(d, strength));
        hn::StoreU(over_all(d, above, hn::LoadU(d, below + x)), d, below + x);
    }
    for (; x < count; ++x) below[x] = over(scaled(top[x], strength), below[x]);
}

void darken(std::uint32_t* pixels, const std::uint8_t* shares, int count) {
    const hn::ScalableTag<std::uint32_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto alpha = hn::Set(d, 0xff000000u);
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        const auto share = hn::PromoteTo(d, hn::LoadU(bytes, shares + x));
        if (hn::AllTrue(d, hn::Eq(share, hn::Set(d, 255)))) continue;
        const auto pixel = hn::LoadU(d, pixels + x);
        hn::StoreU(hn::Or(hn::And(pixel, alpha), hn::AndNot(alpha, scaled_all(d, pixel, share))), d,
                   pixels + x);
    }
    for (; x < count; ++x)
        pixels[x] = (pixels[x] & 0xff000000u) | (scaled(pixels[x], shares[x]) & 0x00ffffffu);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(lay);
HWY_EXPORT(darken);

void lay_over(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength) {
    HWY_DYNAMIC_DISPATCH(lay)(below, top, count, strength);
}

void darken_row(std::uint32_t* pixels, const std::uint8_t* shares, int count) {
    HWY_DYNAMIC_DISPATCH(darken)(pixels, shares, count);
}

}  // namespace grainreel
#endif
