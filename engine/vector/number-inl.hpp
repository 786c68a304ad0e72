// A plain number with the functions that a register has (lanes-inl.hpp), and three of either along x, y, z.
// Formulas that use these alone serve registers, a number by itself, and the numbers of a graphics card
// (engine/card): they are written once.
//
// On its own a number rounds a product and a sum twice. The card's rounds them once, as AVX2 and AVX-512 do
// (GRAINREEL_CARD, one_number.hpp), and has their bits.
#if defined(GRAINREEL_VECTOR_NUMBER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_NUMBER_INL
#undef GRAINREEL_VECTOR_NUMBER_INL
#else
#define GRAINREEL_VECTOR_NUMBER_INL
#endif

#ifdef GRAINREEL_CARD
#include "engine/vector/one_number.hpp"
#else
#include <hwy/highway.h>
#endif

#include <cmath>
#include <concepts>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// The type of the numbers in a register, or of a number itself.
template <class R>
struct NumberIn {
    using type = R;
};
template <class R>
using NumberOf = typename NumberIn<R>::type;

// The functions of LanesOf and MaskOf for a plain number.
template <std::floating_point T>
HWY_INLINE T select(bool which, T yes, T no) {
    return which ? yes : no;
}
template <std::floating_point T>
HWY_INLINE T multiply_add(T a, T b, T c) {
#ifdef GRAINREEL_CARD
    return __builtin_fma(a, b, c);
#else
    return a * b + c;
#endif
}
template <std::floating_point T>
HWY_INLINE T less_product(T c, T a, T b) {
#ifdef GRAINREEL_CARD
    return __builtin_fma(-a, b, c);
#else
    return c - a * b;
#endif
}
template <std::floating_point T>
HWY_INLINE T root(T a) {
#ifdef GRAINREEL_CARD
    return __builtin_sqrt(a);
#else
    return std::sqrt(a);
#endif
}
template <std::floating_point T>
HWY_INLINE T larger(T a, T b) {
    return a > b ? a : b;
}
template <std::floating_point T>
HWY_INLINE T smaller(T a, T b) {
    return a < b ? a : b;
}
template <std::floating_point T>
HWY_INLINE T size_of(T a) {
    return a < 0 ? -a : a;
}
HWY_INLINE bool differ(bool a, bool b) {
    return a != b;
}
HWY_INLINE bool none(bool m) {
    return !m;
}
HWY_INLINE bool all(bool m) {
    return m;
}

// Three numbers along x, y, z.
template <class R>
struct Triple {
    R x, y, z;

    HWY_INLINE R dot(const Triple& b) const { return multiply_add(z, b.z, multiply_add(y, b.y, x * b.x)); }
    HWY_INLINE R squared() const { return dot(*this); }
    HWY_INLINE Triple cross(const Triple& b) const {
        return {less_product(y * b.z, z, b.y), less_product(z * b.x, x, b.z), less_product(x * b.y, y, b.x)};
    }
    // *this + b s, *this - b s.
    HWY_INLINE Triple plus(const Triple& b, const R& s) const {
        return {multiply_add(b.x, s, x), multiply_add(b.y, s, y), multiply_add(b.z, s, z)};
    }
    HWY_INLINE Triple less(const Triple& b, const R& s) const {
        return {less_product(x, b.x, s), less_product(y, b.y, s), less_product(z, b.z, s)};
    }
    // Its part perpendicular to the unit vector k.
    HWY_INLINE Triple across(const Triple& k) const { return less(k, k.dot(*this)); }
    HWY_INLINE Triple operator-() const { return {-x, -y, -z}; }
    HWY_INLINE Triple& operator+=(const Triple& b) {
        x += b.x, y += b.y, z += b.z;
        return *this;
    }
};
template <class R>
HWY_INLINE Triple<R> operator+(const Triple<R>& a, const Triple<R>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
HWY_INLINE Triple<R> operator-(const Triple<R>& a, const Triple<R>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
HWY_INLINE Triple<R> operator*(const Triple<R>& a, const R& s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class R, class M>
HWY_INLINE Triple<R> select(M which, const Triple<R>& yes, const Triple<R>& no) {
    return {select(which, yes.x, no.x), select(which, yes.y, no.y), select(which, yes.z, no.z)};
}

// The difference x of two coordinates, taken to the nearest periodic image.
template <class R>
HWY_INLINE R nearest(R x, R period) {
    const R half = period * R(0.5);
    const R low = select(x > half, x - period, x);
    return select(x < -half, x + period, low);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
