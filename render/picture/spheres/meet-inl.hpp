// Finds where lines of sight meet a sphere, and what a cut leaves of them.
#if defined(GRAINREEL_SPHERES_MEET_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_MEET_INL
#undef GRAINREEL_SPHERES_MEET_INL
#else
#define GRAINREEL_SPHERES_MEET_INL
#endif

#include <limits>

#include "engine/vector/lanes-inl.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

using F = FloatLanes;
constexpr float kNowhere = std::numeric_limits<float>::infinity();

HWY_INLINE F load_any(const float* at) {
    return hn::LoadU(Floats(), at);
}
HWY_INLINE void store_any(F a, float* at) {
    hn::StoreU(a.value, Floats(), at);
}
HWY_INLINE F zero_to_one(F a) {
    return smaller(larger(a, F(0)), F(1));
}
// 1 / sqrt(a) for a > 0, by the processor's estimate and one step of Newton's method; right within 1e-6.
HWY_INLINE F inverse_root(F a) {
    const F y = hn::ApproximateReciprocalSqrt(a.value);
    return y * less_product(F(1.5), F(0.5) * a * y, y);
}
HWY_INLINE F inverse_of(F a) {
    const F y = hn::ApproximateReciprocal(a.value);
    return y * less_product(F(2), a, y);
}

// A line of sight. In perspective x and y are slopes, and its direction is (x, y, 1). In an orthographic view
// x and y are a place, and its direction is (0, 0, 1).
template <bool orthographic>
struct Ray {
    F x, y;
    F square, inverse;  // squared length of the direction, and the inverse of that square

    HWY_INLINE Ray(F slope_x, F slope_y) : x(slope_x), y(slope_y) {
        square = orthographic ? F(1) : multiply_add(x, x, multiply_add(y, y, F(1)));
        inverse = orthographic ? F(1) : F(1) / square;
    }
};

// How a line of sight meets a sphere. along: z of its point nearest to the centre; half: half the chord along
// z; rest: radius^2 - distance^2 (of that point from the centre), < 0 for a miss. Computed from that point,
// rest keeps its digits for spheres that are far away and small (Haines et al. 2019, Ray Tracing Gems, ch.
// 7).
struct Meeting {
    F along, half, rest;
    Triple<F> miss;  // from the centre to the point nearest to it
};

template <bool orthographic>
HWY_INLINE Meeting meet(const Ray<orthographic>& ray, F x, F y, F z, F radius) {
    Meeting m;
    if constexpr (orthographic) {
        m.along = z;
        m.miss = {ray.x - x, ray.y - y, F(0)};
        m.rest = less_product(less_product(radius * radius, m.miss.x, m.miss.x), m.miss.y, m.miss.y);
        m.half = root(larger(m.rest, F(0)));
    } else {
        m.along = multiply_add(x, ray.x, multiply_add(y, ray.y, z)) * ray.inverse;
        m.miss = {multiply_add(m.along, ray.x, -x), multiply_add(m.along, ray.y, -y), m.along - z};
        m.rest = radius * radius - m.miss.squared();
        m.half = root(larger(m.rest, F(0)) * ray.inverse);
    }
    return m;
}

// The part of a line of sight that is not cut away, by z.
struct Kept {
    F low, high;
    F plane;  // number of the plane that `low` lies in, 0 or 1; -1: the eye's plane
};

template <bool orthographic>
HWY_INLINE Kept kept(const Ray<orthographic>& ray, const Cut& cut) {
    Kept k{F(orthographic ? -kNowhere : 0.0f), F(kNowhere), F(-1)};
    for (int i = 0; i < cut.planes; ++i) {
        const Cut::Plane& p = cut.plane[i];
        const F across = multiply_add(F(p.x), ray.x, F(p.y) * ray.y);
        F slope = orthographic ? F(p.z) : across + F(p.z);
        slope = select(size_of(slope) < F(1e-12), F(1e-12), slope);
        const F at = (orthographic ? F(p.d) - across : F(p.d)) / slope;
        const auto opens = slope > F(0);
        const auto later = opens & (at > k.low);
        k.low = select(later, at, k.low);
        k.plane = select(later, F(static_cast<float>(i)), k.plane);
        k.high = select(opens, k.high, smaller(k.high, at));
    }
    return k;
}

// z of the first point of a sphere that is seen, or kNowhere. An eye within the sphere sees its far side.
template <bool orthographic>
HWY_INLINE F seen_at(const Meeting& m) {
    const F entry = m.along - m.half;
    if constexpr (orthographic) return select(m.rest < F(0), F(kNowhere), entry);
    const F away = select(entry > F(0), entry, m.along + m.half);
    return select(smaller(m.rest, away) < F(0), F(kNowhere), away);
}
template <bool orthographic>
HWY_INLINE F seen_at(const Meeting& m, const Kept& k) {
    const F entry = m.along - m.half, exit = m.along + m.half;
    const F eye = select(k.plane < F(0), exit, k.low);
    const F away = select(entry > k.low, entry, eye);
    const F end = smaller(exit, k.high);
    return select((end < away), F(kNowhere), select(m.rest < F(0), F(kNowhere), away));
}

// What a ray sees of the whole sphere, or of what the cut leaves of it.
template <bool cut_open, bool orthographic>
HWY_INLINE F seen_of(const Ray<orthographic>& ray, const Cut& cut, const Meeting& m) {
    if constexpr (cut_open)
        return seen_at<orthographic>(m, kept<orthographic>(ray, cut));
    else
        return seen_at<orthographic>(m);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
