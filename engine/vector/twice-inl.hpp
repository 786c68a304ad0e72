// Two registers that go through a law side by side. The law's chain of operations is longer than what a
// processor can look ahead, so with one register at a time it would wait.
#if defined(GRAINREEL_VECTOR_TWICE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_TWICE_INL
#undef GRAINREEL_VECTOR_TWICE_INL
#else
#define GRAINREEL_VECTOR_TWICE_INL
#endif

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class M>
struct TwiceMask {
    M a, b;

    friend HWY_INLINE TwiceMask operator&(TwiceMask x, TwiceMask y) { return {x.a & y.a, x.b & y.b}; }
    friend HWY_INLINE TwiceMask differ(TwiceMask x, TwiceMask y) {
        return {differ(x.a, y.a), differ(x.b, y.b)};
    }
    friend HWY_INLINE bool none(TwiceMask m) { return none(m.a) && none(m.b); }
    friend HWY_INLINE bool all(TwiceMask m) { return all(m.a) && all(m.b); }
};

template <class L>
struct Twice {
    using Half = L;
    using Tag = typename L::Tag;
    using Number = typename L::Number;
    using Mask = TwiceMask<typename L::Mask>;
    static constexpr int count = 2 * L::count;

    L a, b;

    Twice() = default;
    HWY_INLINE Twice(L one, L two) : a(one), b(two) {}
    HWY_INLINE Twice(double x) : a(x), b(x) {}

    HWY_INLINE Twice& operator+=(Twice y) { return *this = *this + y; }
    HWY_INLINE Twice& operator-=(Twice y) { return *this = *this - y; }
    HWY_INLINE Twice& operator*=(Twice y) { return *this = *this * y; }

    friend HWY_INLINE Twice operator+(Twice x, Twice y) { return {x.a + y.a, x.b + y.b}; }
    friend HWY_INLINE Twice operator-(Twice x, Twice y) { return {x.a - y.a, x.b - y.b}; }
    friend HWY_INLINE Twice operator-(Twice x) { return {-x.a, -x.b}; }
    friend HWY_INLINE Twice operator*(Twice x, Twice y) { return {x.a * y.a, x.b * y.b}; }
    friend HWY_INLINE Twice operator/(Twice x, Twice y) { return {x.a / y.a, x.b / y.b}; }
    friend HWY_INLINE Mask operator<(Twice x, Twice y) { return {x.a < y.a, x.b < y.b}; }
    friend HWY_INLINE Mask operator>(Twice x, Twice y) { return {x.a > y.a, x.b > y.b}; }
    friend HWY_INLINE Mask operator==(Twice x, Twice y) { return {x.a == y.a, x.b == y.b}; }
    friend HWY_INLINE Twice select(Mask which, Twice yes, Twice no) {
        return {select(which.a, yes.a, no.a), select(which.b, yes.b, no.b)};
    }
    friend HWY_INLINE Twice multiply_add(Twice x, Twice y, Twice z) {
        return {multiply_add(x.a, y.a, z.a), multiply_add(x.b, y.b, z.b)};
    }
    friend HWY_INLINE Twice less_product(Twice z, Twice x, Twice y) {
        return {less_product(z.a, x.a, y.a), less_product(z.b, x.b, y.b)};
    }
    friend HWY_INLINE Twice root(Twice x) { return {root(x.a), root(x.b)}; }
    friend HWY_INLINE Twice larger(Twice x, Twice y) { return {larger(x.a, y.a), larger(x.b, y.b)}; }
    friend HWY_INLINE Twice smaller(Twice x, Twice y) { return {smaller(x.a, y.a), smaller(x.b, y.b)}; }
    friend HWY_INLINE Twice size_of(Twice x) { return {size_of(x.a), size_of(x.b)}; }
};

template <class L>
struct NumberIn<Twice<L>> {
    using type = NumberOf<L>;
};

template <class L>
HWY_INLINE void store(Twice<L> x, typename L::Number* at) {
    store(x.a, at), store(x.b, at + L::count);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
