// A bundle: four or eight doubles that lie together in memory, such as the position and radius of a grain. It
// is held in one register or in several, depending on the instruction set.
#if defined(GRAINREEL_VECTOR_BUNDLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_BUNDLE_INL
#undef GRAINREEL_VECTOR_BUNDLE_INL
#else
#define GRAINREEL_VECTOR_BUNDLE_INL
#endif

#include "engine/base/vector.hpp"
#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <int size>
struct Bundle {
    using D = hn::CappedTag<double, size>;
    static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));
    static constexpr int parts = size / lanes;
    hn::Vec<D> part[parts];
};

template <int size>
HWY_INLINE Bundle<size> bundle_at(const double* from) {
    Bundle<size> r;
    for (int p = 0; p < r.parts; ++p) r.part[p] = hn::Load(typename Bundle<size>::D(), from + p * r.lanes);
    return r;
}
template <int size>
HWY_INLINE void put(const Bundle<size>& r, double* to) {
    for (int p = 0; p < r.parts; ++p) hn::Store(r.part[p], typename Bundle<size>::D(), to + p * r.lanes);
}
// Two bundles as one of twice the size.
template <int size>
HWY_INLINE Bundle<2 * size> both(const Bundle<size>& first, const Bundle<size>& second) {
    Bundle<2 * size> r;
#if HWY_TARGET != HWY_SCALAR
    if constexpr (r.parts == 1) {
        r.part[0] = hn::Combine(typename Bundle<2 * size>::D(), second.part[0], first.part[0]);
        return r;
    }
#endif
    if constexpr (r.parts > 1) {
        constexpr int half = Bundle<size>::parts;
        for (int p = 0; p < half; ++p) r.part[p] = first.part[p], r.part[half + p] = second.part[p];
    }
    return r;
}

template <int size>
HWY_INLINE Bundle<4> first_four(const Bundle<size>& r) {
    Bundle<4> first;
    if constexpr (size == 4) return r;
#if HWY_TARGET != HWY_SCALAR
    if constexpr (Bundle<size>::lanes > 4) {
        first.part[0] = hn::LowerHalf(Bundle<4>::D(), r.part[0]);
        return first;
    }
#endif
    if constexpr (Bundle<size>::lanes <= 4) {
        for (int p = 0; p < first.parts; ++p) first.part[p] = r.part[p];
    }
    return first;
}

template <int size>
HWY_INLINE void put_rounded(const Bundle<size>& r, float* to) {
    const hn::Rebind<float, typename Bundle<size>::D> floats;
    for (int p = 0; p < r.parts; ++p) hn::Store(hn::DemoteTo(floats, r.part[p]), floats, to + p * r.lanes);
}
HWY_INLINE Bundle<4> bundle_of(double x) {
    Bundle<4> r;
    for (auto& part : r.part) part = hn::Set(Bundle<4>::D(), x);
    return r;
}
// A bundle of four numbers, put together in registers. If they were stored one by one and loaded together,
// the load would wait for the stores.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Bundle<4> bundle_of(double a, double b, double c, double d) {
    const Bundle<4>::D one;
    return {{hn::Set(one, a), hn::Set(one, b), hn::Set(one, c), hn::Set(one, d)}};
}
#else
template <class Four = Bundle<4> >
HWY_INLINE Four bundle_of(double a, double b, double c, double d) {
    const hn::FixedTag<double, 2> two;
    const auto low = hn::InterleaveLower(two, hn::Set(two, a), hn::Set(two, b));
    const auto high = hn::InterleaveLower(two, hn::Set(two, c), hn::Set(two, d));
    if constexpr (Four::parts == 2)
        return {{low, high}};
    else
        return {{hn::Combine(typename Four::D(), high, low)}};
}
#endif
HWY_INLINE Bundle<4> bundle_of(const Vec3& v, double fourth = 0) {
    return bundle_of(v.x(), v.y(), v.z(), fourth);
}
// a, but with x as its last number.
template <int size>
HWY_INLINE Bundle<size> with_last(Bundle<size> a, double x) {
    constexpr int last = Bundle<size>::parts - 1, lanes = Bundle<size>::lanes;
    const typename Bundle<size>::D d;
    if constexpr (lanes == 1)
        a.part[last] = hn::Set(d, x);
    else
        a.part[last] = hn::IfThenElse(hn::FirstN(d, lanes - 1), a.part[last], hn::Set(d, x));
    return a;
}
template <int size>
HWY_INLINE Bundle<size> operator+(Bundle<size> a, const Bundle<size>& b) {
    for (int p = 0; p < a.parts; ++p) a.part[p] = hn::Add(a.part[p], b.part[p]);
    return a;
}
template <int size>
HWY_INLINE Bundle<size> operator-(Bundle<size> a, const Bundle<size>& b) {
    for (int p = 0; p < a.parts; ++p) a.part[p] = hn::Sub(a.part[p], b.part[p]);
    return a;
}
template <int size>
HWY_INLINE Bundle<size> operator*(Bundle<size> a, const Bundle<size>& b) {
    for (int p = 0; p < a.parts; ++p) a.part[p] = hn::Mul(a.part[p], b.part[p]);
    return a;
}
// a b + c, rounded once if the processor can do that.
template <int size>
HWY_INLINE Bundle<size> multiply_add(Bundle<size> a, const Bundle<size>& b, const Bundle<size>& c) {
    for (int p = 0; p < a.parts; ++p) a.part[p] = hn::MulAdd(a.part[p], b.part[p], c.part[p]);
    return a;
}
// The same, with zero for each number whose size is below `least`.
template <int size>
HWY_INLINE Bundle<size> without_tiny(Bundle<size> a, double least) {
    const typename Bundle<size>::D d;
    for (auto& part : a.part) part = hn::IfThenZeroElse(hn::Lt(hn::Abs(part), hn::Set(d, least)), part);
    return a;
}
// The larger of a and |b|, number by number.
template <int size>
HWY_INLINE Bundle<size> larger_size(Bundle<size> a, const Bundle<size>& b) {
    for (int p = 0; p < a.parts; ++p) a.part[p] = hn::Max(a.part[p], hn::Abs(b.part[p]));
    return a;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
