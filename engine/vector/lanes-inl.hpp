// Lanes: a register of doubles or floats that is used like a number (number-inl.hpp), so that a law is
// written once for all widths and for a plain double. The file is compiled for each instruction set; the
// guard below is that of Highway's foreach_target.h.
//
// Multiplications and additions are fused where the code says so and the processor can do it. So AVX2,
// AVX-512 and NEON give the same bits. SSE4 and the code for plain numbers round twice and give other bits.
#if defined(GRAINREEL_VECTOR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_LANES_INL
#undef GRAINREEL_VECTOR_LANES_INL
#else
#define GRAINREEL_VECTOR_LANES_INL
#endif

#include <cstdint>
#include <type_traits>

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;  // as wide as the processor's registers, at most 8
using Floats = hn::CappedTag<float, 16>;

template <class D>
struct MaskOf {
    hn::Mask<D> bits;

    friend HWY_INLINE MaskOf operator&(MaskOf a, MaskOf b) { return {hn::And(a.bits, b.bits)}; }
    friend HWY_INLINE MaskOf differ(MaskOf a, MaskOf b) { return {hn::Xor(a.bits, b.bits)}; }
    friend HWY_INLINE bool none(MaskOf m) { return hn::AllFalse(D(), m.bits); }
    friend HWY_INLINE bool all(MaskOf m) { return hn::AllTrue(D(), m.bits); }
    friend HWY_INLINE std::uint64_t bits(MaskOf m) {  // lane 0 is the lowest bit
        static_assert(hn::MaxLanes(D()) <= 8);
        std::uint8_t byte[8] = {};
        hn::StoreMaskBits(D(), m.bits, byte);
        return byte[0];
    }
};

template <class D>
struct LanesOf {
    using Tag = D;
    using Number = hn::TFromD<D>;
    using Mask = MaskOf<D>;
    static constexpr int count = static_cast<int>(hn::MaxLanes(D()));

    hn::Vec<D> value;

    LanesOf() = default;
    HWY_INLINE LanesOf(hn::Vec<D> v) : value(v) {}
    HWY_INLINE LanesOf(double x) : value(hn::Set(D(), static_cast<Number>(x))) {}

    HWY_INLINE LanesOf& operator+=(LanesOf b) { return value = hn::Add(value, b.value), *this; }
    HWY_INLINE LanesOf& operator-=(LanesOf b) { return value = hn::Sub(value, b.value), *this; }
    HWY_INLINE LanesOf& operator*=(LanesOf b) { return value = hn::Mul(value, b.value), *this; }

    friend HWY_INLINE LanesOf operator+(LanesOf a, LanesOf b) { return hn::Add(a.value, b.value); }
    friend HWY_INLINE LanesOf operator-(LanesOf a, LanesOf b) { return hn::Sub(a.value, b.value); }
    friend HWY_INLINE LanesOf operator-(LanesOf a) { return hn::Neg(a.value); }
    friend HWY_INLINE LanesOf operator*(LanesOf a, LanesOf b) { return hn::Mul(a.value, b.value); }
    friend HWY_INLINE LanesOf operator/(LanesOf a, LanesOf b) { return hn::Div(a.value, b.value); }
    friend HWY_INLINE Mask operator<(LanesOf a, LanesOf b) { return {hn::Lt(a.value, b.value)}; }
    friend HWY_INLINE Mask operator>(LanesOf a, LanesOf b) { return {hn::Gt(a.value, b.value)}; }
    friend HWY_INLINE Mask operator==(LanesOf a, LanesOf b) { return {hn::Eq(a.value, b.value)}; }
    friend HWY_INLINE LanesOf select(Mask which, LanesOf yes, LanesOf no) {
        return hn::IfThenElse(which.bits, yes.value, no.value);
    }
    // a b + c and c - a b, rounded once if the processor can do that.
    friend HWY_INLINE LanesOf multiply_add(LanesOf a, LanesOf b, LanesOf c) {
        return hn::MulAdd(a.value, b.value, c.value);
    }
    friend HWY_INLINE LanesOf less_product(LanesOf c, LanesOf a, LanesOf b) {
        return hn::NegMulAdd(a.value, b.value, c.value);
    }
    friend HWY_INLINE LanesOf root(LanesOf a) { return hn::Sqrt(a.value); }
    // a > b ? a : b, and so b if one of them is no number or both are zeros. x86 has an instruction for this.
    // Those of ARM tell zeros of two signs apart, and the bits would be others.
    friend HWY_INLINE LanesOf larger(LanesOf a, LanesOf b) {
        return HWY_ARCH_X86 ? hn::Max(a.value, b.value)
                            : hn::IfThenElse(hn::Gt(a.value, b.value), a.value, b.value);
    }
    friend HWY_INLINE LanesOf smaller(LanesOf a, LanesOf b) {
        return HWY_ARCH_X86 ? hn::Min(a.value, b.value)
                            : hn::IfThenElse(hn::Lt(a.value, b.value), a.value, b.value);
    }
    friend HWY_INLINE LanesOf size_of(LanesOf a) { return hn::Abs(a.value); }
};

using Lanes = LanesOf<Doubles>;
using FloatLanes = LanesOf<Floats>;
using LanesMask = Lanes::Mask;
constexpr int kLanes = Lanes::count;

template <class D>
struct NumberIn<LanesOf<D>> {
    using type = hn::TFromD<D>;
};

// `at` must be aligned to the register. A type that consists of two registers (`Twice`) names the type of one
// of them `Half`, and is loaded in two halves.
template <class L = Lanes>
HWY_INLINE L load(const typename L::Number* at) {
    if constexpr (requires { typename L::Half; })
        return {load<typename L::Half>(at), load<typename L::Half>(at + L::Half::count)};
    else
        return hn::Load(typename L::Tag(), at);
}
template <class D>
HWY_INLINE void store(LanesOf<D> a, hn::TFromD<D>* at) {
    hn::Store(a.value, D(), at);
}

// Loads and stores where memory and register may differ in precision. A tag D of floats has as many lanes as
// one of doubles (half a register), or twice as many (a whole one, which takes two registers of doubles).
template <class D>
requires(LanesOf<D>::count == kLanes) HWY_INLINE hn::Vec<D> rounded(D d, const double* at) {
    return hn::DemoteTo(d, hn::Load(Doubles(), at));
}
template <class D>
requires(LanesOf<D>::count == kLanes) HWY_INLINE void widen(D, hn::Vec<D> a, double* at) {
    hn::Store(hn::PromoteTo(Doubles(), a), Doubles(), at);
}
#if HWY_TARGET != HWY_SCALAR
template <class D>
requires(LanesOf<D>::count == 2 * kLanes) HWY_INLINE hn::Vec<D> rounded(D d, const double* at) {
    const hn::Half<D> half;
    return hn::Combine(d, rounded(half, at + kLanes), rounded(half, at));
}
template <class D>
requires(LanesOf<D>::count == 2 * kLanes) HWY_INLINE void widen(D /*d*/, hn::Vec<D> a, double* at) {
    const hn::Half<D> half;
    widen(half, hn::LowerHalf(half, a), at);
    widen(half, hn::UpperHalf(half, a), at + kLanes);
}
#endif
template <class L>
requires(std::is_same_v<NumberOf<L>, float>) HWY_INLINE L load_as(const float* at) {
    return load<L>(at);
}
template <class L>
HWY_INLINE L load_as(const double* at) {
    if constexpr (std::is_same_v<NumberOf<L>, double>)
        return load<L>(at);
    else
        return rounded(typename L::Tag(), at);
}
template <class D>
HWY_INLINE void store_as(LanesOf<D> a, float* at) {
    if constexpr (std::is_same_v<D, Doubles>) {
        const hn::Rebind<float, Doubles> floats;
        hn::Store(hn::DemoteTo(floats, a.value), floats, at);
    } else {
        store(a, at);
    }
}
template <class L>
requires(!std::is_same_v<L, LanesOf<typename L::Tag>>) HWY_INLINE void store_as(L a, NumberOf<L>* at) {
    store(a, at);
}
template <class D>
HWY_INLINE void store_as(LanesOf<D> a, double* at) {
    if constexpr (std::is_same_v<D, Doubles>)
        store(a, at);
    else
        widen(D(), a.value, at);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
