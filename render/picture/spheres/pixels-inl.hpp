// scaled() and over() of layer.hpp for a register of pixels.
#if defined(GRAINREEL_SPHERES_PIXELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_PIXELS_INL
#undef GRAINREEL_SPHERES_PIXELS_INL
#else
#define GRAINREEL_SPHERES_PIXELS_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// share: 0 to 255, for each lane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V scaled_all(D d, V pixels, V share) {
    const V even = hn::Set(d, 0x00ff00ffu), half = hn::Set(d, 0x00800080u);
    const auto pair = [&](V two) {
        const V product = hn::Add(hn::Mul(two, share), half);
        return hn::And(hn::ShiftRight<8>(hn::Add(product, hn::And(hn::ShiftRight<8>(product), even))), even);
    };
    return hn::Add(pair(hn::And(pixels, even)),
                   hn::ShiftLeft<8>(pair(hn::And(hn::ShiftRight<8>(pixels), even))));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V over_all(D d, V top, V below) {
    return hn::Add(top, scaled_all(d, below, hn::Sub(hn::Set(d, 255), hn::ShiftRight<24>(top))));
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
