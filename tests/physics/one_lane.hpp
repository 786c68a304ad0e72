// A single number that does what a lane of a register does, so that a law can be run beside its kernel and
// give the same bits. Multiplications and additions are fused or not.
#pragma once

#include <cmath>

#include "engine/laws/softness-inl.hpp"

namespace grainreel::HWY_NAMESPACE {

template <class Number, bool fused>
struct OneLane {
    Number value{};

    OneLane() = default;
    OneLane(double x) : value(static_cast<Number>(x)) {}
    static OneLane of(Number x) {
        OneLane lane;
        lane.value = x;
        return lane;
    }

    OneLane& operator+=(OneLane b) { return *this = *this + b; }
    OneLane& operator-=(OneLane b) { return *this = *this - b; }
    OneLane& operator*=(OneLane b) { return *this = *this * b; }

    friend OneLane operator+(OneLane a, OneLane b) { return of(a.value + b.value); }
    friend OneLane operator-(OneLane a, OneLane b) { return of(a.value - b.value); }
    friend OneLane operator-(OneLane a) { return of(-a.value); }
    friend OneLane operator*(OneLane a, OneLane b) { return of(a.value * b.value); }
    friend OneLane operator/(OneLane a, OneLane b) { return of(a.value / b.value); }
    friend bool operator<(OneLane a, OneLane b) { return a.value < b.value; }
    friend bool operator>(OneLane a, OneLane b) { return a.value > b.value; }
    friend bool operator==(OneLane a, OneLane b) { return a.value == b.value; }
    friend OneLane select(bool which, OneLane yes, OneLane no) { return which ? yes : no; }
    friend OneLane multiply_add(OneLane a, OneLane b, OneLane c) {
        return of(fused ? std::fma(a.value, b.value, c.value) : a.value * b.value + c.value);
    }
    friend OneLane less_product(OneLane c, OneLane a, OneLane b) { return multiply_add(-a, b, c); }
    friend OneLane root(OneLane a) { return of(std::sqrt(a.value)); }
    friend OneLane larger(OneLane a, OneLane b) { return a > b ? a : b; }
    friend OneLane smaller(OneLane a, OneLane b) { return a < b ? a : b; }
    friend OneLane size_of(OneLane a) { return of(a.value < 0 ? -a.value : a.value); }
};

template <class Number, bool fused>
struct NumberIn<OneLane<Number, fused>> {
    using type = Number;
};

template <class Number, bool fused>
OneLane<Number, fused> guess_inverse_cube_root(OneLane<Number, fused> x) {
    return OneLane<Number, fused>::of(guess_inverse_cube_root(x.value));
}
template <class Number, bool fused>
OneLane<Number, fused> any_root(OneLane<Number, fused> a, OneLane<Number, fused> b,
                                OneLane<Number, fused> gamma) {
    return OneLane<Number, fused>::of(any_root(a.value, b.value, gamma.value));
}

}  // namespace grainreel::HWY_NAMESPACE
