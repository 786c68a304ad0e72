// Powers of a number in [0, 1]. The exponents that occur, 1/3, 1 and 2, need no library call, which would
// cost as much as the rest of the tangential law.
#if defined(GRAINREEL_LAWS_POWER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_POWER_INL
#undef GRAINREEL_LAWS_POWER_INL
#else
#define GRAINREEL_LAWS_POWER_INL
#endif

#include <bit>

#include "engine/base/mathematics.hpp"
#include "engine/vector/twice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Subtracting a third of the bits of x, read as an integer, from this constant gives about the bits of
// x^(-1/3).
HWY_INLINE std::uint64_t inverse_cube_root_bits(double) {
    return 0x553ee0ff289dd796;
}
HWY_INLINE std::uint32_t inverse_cube_root_bits(float) {
    return 0x54a21d2a;
}

// First guess of x^(-1/3). Shifts divide the bits of x by three, near enough for a guess.
template <class D>
HWY_INLINE LanesOf<D> guess_inverse_cube_root(LanesOf<D> x) {
    const hn::RebindToUnsigned<D> bits;
    const auto b = hn::BitCast(bits, x.value);
    auto third = hn::ShiftRight<2>(b);
    third = hn::Add(third, hn::ShiftRight<2>(third));
    third = hn::Add(third, hn::ShiftRight<4>(third));
    third = hn::Add(third, hn::ShiftRight<8>(third));
    return hn::BitCast(D(), hn::Sub(hn::Set(bits, inverse_cube_root_bits(hn::TFromD<D>())), third));
}
template <std::floating_point T>
HWY_INLINE T guess_inverse_cube_root(T x) {
    const auto of_one_third = inverse_cube_root_bits(T());
    auto third = std::bit_cast<std::remove_const_t<decltype(of_one_third)>>(x) >> 2;
    third += third >> 2;
    third += third >> 4;
    third += third >> 8;
    return std::bit_cast<T>(of_one_third - third);
}

// Computes x^(1/3) for x in [0, 1], to the last digits; 0 below 1e-30. Newton's method for the inverse root
// has no division.
template <class R>
HWY_INLINE R cube_root(R x) {
    constexpr int rounds = sizeof(NumberOf<R>) == sizeof(double) ? 4 : 3;
    const R third = x * R(1.0 / 3.0);
    R r = guess_inverse_cube_root(x);
    for (int k = 0; k < rounds; ++k) r *= less_product(R(4.0 / 3.0), third, r * r * r);
    const R y = x * r * r;
    return select(x > R(1e-30), y, R(0));
}

template <std::floating_point T>
HWY_INLINE T any_power(T base, T exponent) {
    return static_cast<T>(math::pow(base, exponent));
}
template <class D>
HWY_INLINE LanesOf<D> any_power(LanesOf<D> base, LanesOf<D> exponent);

template <class L>
HWY_INLINE Twice<L> guess_inverse_cube_root(Twice<L> x) {
    return {guess_inverse_cube_root(x.a), guess_inverse_cube_root(x.b)};
}
template <class L>
HWY_INLINE Twice<L> any_power(Twice<L> base, Twice<L> exponent) {
    return {any_power(base.a, exponent.a), any_power(base.b, exponent.b)};
}

template <class R>
HWY_INLINE R power(R base, R exponent) {
    if (all(exponent == R(1.0 / 3.0))) return cube_root(base);
    if (all(exponent == R(1))) return base;
    if (all(exponent == R(2))) return base * base;
    return any_power(base, exponent);
}

// Computes powers lane by lane. This is slow, and gives the same bits at every register width. Cube roots
// have the same bits as in power(), so that a result does not depend on which contacts share a register.
template <class D>
HWY_INLINE LanesOf<D> any_power(LanesOf<D> base, LanesOf<D> exponent) {
    HWY_ALIGN hn::TFromD<D> b[LanesOf<D>::count], e[LanesOf<D>::count];
    store(base, b), store(exponent, e);
    for (int k = 0; k < LanesOf<D>::count; ++k) {
        if (e[k] == 2)
            b[k] *= b[k];
        else if (e[k] != 1 && e[k] != static_cast<hn::TFromD<D>>(1.0 / 3.0))
            b[k] = any_power(b[k], e[k]);
    }
    const LanesOf<D> third(1.0 / 3.0);
    return select(exponent == third, cube_root(base), load<LanesOf<D>>(b));
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
