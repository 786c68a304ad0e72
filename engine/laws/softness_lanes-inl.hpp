// The parts of softness-inl.hpp that look into registers.
#if defined(GRAINREEL_LAWS_SOFTNESS_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_SOFTNESS_LANES_INL
#undef GRAINREEL_LAWS_SOFTNESS_LANES_INL
#else
#define GRAINREEL_LAWS_SOFTNESS_LANES_INL
#endif

#include "engine/laws/softness-inl.hpp"
#include "engine/vector/twice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// First guess of x^(-1/3).
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

// Goes through the lanes one by one. This is slow, and gives the same bits at every register width. The usual
// exponents have the same bits as in softness(), so that a result does not depend on which contacts share a
// register.
template <class D>
HWY_INLINE LanesOf<D> any_root(LanesOf<D> a, LanesOf<D> b, LanesOf<D> gamma) {
    using Number = hn::TFromD<D>;
    HWY_ALIGN Number as[LanesOf<D>::count], bs[LanesOf<D>::count], gammas[LanesOf<D>::count];
    store(a, as), store(b, bs), store(gamma, gammas);
    const auto third = static_cast<Number>(1.0 / 3.0);
    for (int k = 0; k < LanesOf<D>::count; ++k) {
        if (gammas[k] != 1 && gammas[k] != 2 && gammas[k] != third) as[k] = any_root(as[k], bs[k], gammas[k]);
    }
    using L = LanesOf<D>;
    const L other =
        select(gamma == L(1), linear_root(a, b), select(gamma == L(2), quadratic_root(a, b), load<L>(as)));
    return select(gamma == L(1.0 / 3.0), cubic_root(a, b), other);
}

template <class L>
HWY_INLINE Twice<L> guess_inverse_cube_root(Twice<L> x) {
    return {guess_inverse_cube_root(x.a), guess_inverse_cube_root(x.b)};
}
template <class L>
HWY_INLINE Twice<L> any_root(Twice<L> a, Twice<L> b, Twice<L> gamma) {
    return {any_root(a.a, b.a, gamma.a), any_root(a.b, b.b, gamma.b)};
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
