// How soft a contact with incremental slip is in the middle of a step: the factor y = u^gamma, where u is the
// room left before the contact slides. The slip of the step itself takes room, so y and u follow from each
// other,
//
//   u = a - b y,   or   y^(1/gamma) + b y = a.
//
// The exponents that occur, 1/3, 1 and 2, need no library call, which would cost as much as the rest of the
// tangential law.
#if defined(GRAINREEL_LAWS_SOFTNESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_SOFTNESS_INL
#undef GRAINREEL_LAWS_SOFTNESS_INL
#else
#define GRAINREEL_LAWS_SOFTNESS_INL
#endif

#include <bit>
#include <cstdint>

#include "engine/base/mathematics.hpp"
#include "engine/vector/number-inl.hpp"

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
template <std::floating_point T>
HWY_INLINE T guess_inverse_cube_root(T x) {
    const auto of_one_third = inverse_cube_root_bits(T());
    auto third = std::bit_cast<std::remove_const_t<decltype(of_one_third)>>(x) >> 2;
    third += third >> 2;
    third += third >> 4;
    third += third >> 8;
    return std::bit_cast<T>(of_one_third - third);
}

// Solves y^3 + b y = a by Newton's method. It begins near the root for b = 0, from which both steps come down
// to the root: they are off by less than 1/20 where the slip of a step takes all room, and by nothing where
// it takes little. Both steps share one division.
template <class R>
HWY_INLINE R cubic_root(R a, R b) {
    constexpr int rounds = sizeof(NumberOf<R>) == sizeof(double) ? 3 : 2;
    const R third = a * R(1.0 / 3.0);
    R r = guess_inverse_cube_root(a);  // to ten digits after three rounds, for which no division is needed
    for (int k = 0; k < rounds; ++k) r *= less_product(R(4.0 / 3.0), third, r * r * r);
    const R y = a * r * r, square = y * y;
    // The first step ends at above / below.
    const R above = multiply_add(R(2) * square, y, a), below = multiply_add(R(3), square, b);
    const R above_2 = above * above, below_2 = below * below;
    return multiply_add(R(2) * above_2, above, a * below_2 * below) /
           (below * multiply_add(R(3), above_2, b * below_2));
}

// The same for gamma = 1 and 2, in closed form.
template <class R>
HWY_INLINE R linear_root(R a, R b) {
    return a / (R(1) + b);
}
template <class R>
HWY_INLINE R quadratic_root(R a, R b) {
    const R u = R(2) * a / (R(1) + root(multiply_add(R(4) * a, b, R(1))));
    return u * u;
}

// For any gamma: one step of Newton's method from u = a, because a power costs as much as the rest of the
// law. It is of second order too.
template <std::floating_point T>
HWY_INLINE T any_root([[maybe_unused]] T a, [[maybe_unused]] T b, [[maybe_unused]] T gamma) {
#ifdef GRAINREEL_CARD
    return __builtin_nan("");  // such exponents are refused (engine/card/refusal.hpp)
#else
    const T alone = static_cast<T>(math::pow(a, gamma));
    return smaller(alone / (1 + gamma * b * alone / a), a / larger(b, static_cast<T>(1e-9)));
#endif
}
// The solution y for a in [1e-9, 1e7], b in [0, 1e7], and y at most about 1.
template <class R>
HWY_INLINE R softness(R a, R b, R gamma) {
    if (all(gamma == R(1.0 / 3.0))) return cubic_root(a, b);
    if (all(gamma == R(1))) return linear_root(a, b);
    if (all(gamma == R(2))) return quadratic_root(a, b);
    return any_root(a, b, gamma);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
