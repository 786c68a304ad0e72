// A register of doubles that reads like one number, so that a law is written once for all widths and for a
// plain double. Compiled anew for each instruction set: see Highway's foreach_target.h for the guard below.
//
// No fused multiply-add: each operation rounds as it does on a double, so every width gives the same bits.
#if defined(GRAINREEL_VECTOR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_LANES_INL
#undef GRAINREEL_VECTOR_LANES_INL
#else
#define GRAINREEL_VECTOR_LANES_INL
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;  // as many as the machine has, at most a block of contacts
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));

struct LanesMask {
    hn::Mask<Doubles> bits;
};

struct Lanes {
    hn::Vec<Doubles> value;

    Lanes() = default;
    HWY_INLINE Lanes(hn::Vec<Doubles> v) : value(v) {}
    HWY_INLINE Lanes(double x) : value(hn::Set(Doubles(), x)) {}

    HWY_INLINE Lanes& operator+=(Lanes b) { return value = hn::Add(value, b.value), *this; }
    HWY_INLINE Lanes& operator-=(Lanes b) { return value = hn::Sub(value, b.value), *this; }
    HWY_INLINE Lanes& operator*=(Lanes b) { return value = hn::Mul(value, b.value), *this; }
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) {
    return hn::Add(a.value, b.value);
}
HWY_INLINE Lanes operator-(Lanes a, Lanes b) {
    return hn::Sub(a.value, b.value);
}
HWY_INLINE Lanes operator-(Lanes a) {
    return hn::Neg(a.value);
}
HWY_INLINE Lanes operator*(Lanes a, Lanes b) {
    return hn::Mul(a.value, b.value);
}
HWY_INLINE Lanes operator/(Lanes a, Lanes b) {
    return hn::Div(a.value, b.value);
}
HWY_INLINE LanesMask operator<(Lanes a, Lanes b) {
    return {hn::Lt(a.value, b.value)};
}
HWY_INLINE LanesMask operator>(Lanes a, Lanes b) {
    return {hn::Gt(a.value, b.value)};
}
HWY_INLINE LanesMask operator==(Lanes a, Lanes b) {
    return {hn::Eq(a.value, b.value)};
}
HWY_INLINE LanesMask operator&(LanesMask a, LanesMask b) {
    return {hn::And(a.bits, b.bits)};
}
HWY_INLINE Lanes select(LanesMask which, Lanes yes, Lanes no) {
    return hn::IfThenElse(which.bits, yes.value, no.value);
}
HWY_INLINE Lanes root(Lanes a) {
    return hn::Sqrt(a.value);
}
HWY_INLINE Lanes larger(Lanes a, Lanes b) {
    return hn::Max(a.value, b.value);
}
HWY_INLINE Lanes smaller(Lanes a, Lanes b) {
    return hn::Min(a.value, b.value);
}
HWY_INLINE Lanes size_of(Lanes a) {
    return hn::Abs(a.value);
}
HWY_INLINE bool none(LanesMask m) {
    return hn::AllFalse(Doubles(), m.bits);
}
HWY_INLINE bool all(LanesMask m) {
    return hn::AllTrue(Doubles(), m.bits);
}
HWY_INLINE std::uint64_t bits(LanesMask m) {  // the first lane is the lowest
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(Doubles(), m.bits, byte);
    return byte[0];
}

// The same for one double.
HWY_INLINE double select(bool which, double yes, double no) {
    return which ? yes : no;
}
HWY_INLINE double root(double a) {
    return std::sqrt(a);
}
HWY_INLINE double larger(double a, double b) {
    return a > b ? a : b;
}
HWY_INLINE double smaller(double a, double b) {
    return a < b ? a : b;
}
HWY_INLINE double size_of(double a) {
    return a < 0 ? -a : a;
}
HWY_INLINE bool none(bool m) {
    return !m;
}
HWY_INLINE bool all(bool m) {
    return m;
}

// Memory is laid out in rows of 8 doubles, whatever the width; `from` is aligned to the register.
HWY_INLINE Lanes load(const double* from) {
    return hn::Load(Doubles(), from);
}
HWY_INLINE void store(Lanes a, double* to) {
    hn::Store(a.value, Doubles(), to);
}

// Three numbers along x, y, z.
template <class R>
struct Triple {
    R x, y, z;

    HWY_INLINE R dot(const Triple& b) const { return x * b.x + y * b.y + z * b.z; }
    HWY_INLINE R squared() const { return dot(*this); }
    HWY_INLINE Triple cross(const Triple& b) const {
        return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
    }
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

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
