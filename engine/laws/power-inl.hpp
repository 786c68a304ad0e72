// Powers of a number in [0, 1]. The exponents that occur, 1/3, 1 and 2, need no library call, which would
// cost as much as the rest of the tangential law.
#if defined(GRAINREEL_LAWS_POWER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_POWER_INL
#undef GRAINREEL_LAWS_POWER_INL
#else
#define GRAINREEL_LAWS_POWER_INL
#endif

#include <bit>

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Bits of x shifted right: an integer a third as large, near enough for a first guess.
HWY_INLINE Lanes guess_inverse_cube_root(Lanes x) {
    const hn::RebindToUnsigned<Doubles> bits;
    const auto b = hn::BitCast(bits, x.value);
    auto third = hn::ShiftRight<2>(b);
    third = hn::Add(third, hn::ShiftRight<2>(third));
    third = hn::Add(third, hn::ShiftRight<4>(third));
    third = hn::Add(third, hn::ShiftRight<8>(third));
    return hn::BitCast(Doubles(), hn::Sub(hn::Set(bits, 0x553ee0ff289dd796ULL), third));
}
HWY_INLINE double guess_inverse_cube_root(double x) {
    std::uint64_t third = std::bit_cast<std::uint64_t>(x) >> 2;
    third += third >> 2;
    third += third >> 4;
    third += third >> 8;
    return std::bit_cast<double>(0x553ee0ff289dd796ULL - third);
}

// x^(1/3) for x in [0, 1e100], to about 1e-15 of itself; 0 below 1e-100. Newton's method for the inverse
// root has no division.
template <class R>
HWY_INLINE R cube_root(R x) {
    R r = guess_inverse_cube_root(x);
    for (int k = 0; k < 4; ++k) r *= R(4.0 / 3.0) - x * (r * r * r) * R(1.0 / 3.0);
    const R y = x * r * r;
    return select(x > R(1e-100), y, R(0));
}

HWY_INLINE double any_power(double base, double exponent) {
    return std::pow(base, exponent);
}
HWY_INLINE Lanes any_power(Lanes base, Lanes exponent);

template <class R>
HWY_INLINE R power(R base, R exponent) {
    if (all(exponent == R(1.0 / 3.0))) return cube_root(base);
    if (all(exponent == R(1))) return base;
    if (all(exponent == R(2))) return base * base;
    return any_power(base, exponent);
}

// Lane by lane, each as if it were alone: slow, and the same at every width.
HWY_INLINE Lanes any_power(Lanes base, Lanes exponent) {
    HWY_ALIGN double b[kLanes], e[kLanes];
    store(base, b), store(exponent, e);
    for (int k = 0; k < kLanes; ++k) b[k] = power(b[k], e[k]);
    return load(b);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
