// Finds where lines of sight meet an ellipsoid or a superquadric. An ellipsoid has a closed form: along its
// own axes, in half lengths, it is a sphere. A superquadric is convex, so Newton's method finds both ends of
// the chord from outside.
#if defined(GRAINREEL_SPHERES_MEET_SHAPE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_MEET_SHAPE_INL
#undef GRAINREEL_SPHERES_MEET_SHAPE_INL
#else
#define GRAINREEL_SPHERES_MEET_SHAPE_INL
#endif

#include <hwy/contrib/math/math-inl.h>

#include "render/picture/spheres/meet-inl.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE F::Mask operator|(F::Mask a, F::Mask b) {
    return {hn::Or(a.bits, b.bits)};
}
HWY_INLINE F exponential(F a) {
    return hn::Exp(Floats(), a.value);
}
HWY_INLINE F logarithm(F a) {
    return hn::Log(Floats(), a.value);
}

// A ViewShape in each lane.
struct ShapeLanes {
    Triple<F> row[3];
    F along, around;  // the powers

    // A vector from the centre, in half lengths along the shape's own axes.
    HWY_INLINE Triple<F> unit(const Triple<F>& v) const {
        return {row[0].dot(v), row[1].dot(v), row[2].dot(v)};
    }
    // The direction of a gradient that is known along the shape's own axes.
    HWY_INLINE Triple<F> normal(const Triple<F>& gradient) const {
        const Triple<F> sum = (row[0] * gradient.x).plus(row[1], gradient.y).plus(row[2], gradient.z);
        return sum * inverse_root(larger(sum.squared(), F(1e-30)));
    }
    HWY_INLINE bool all_ellipsoids() const { return none((along > F(2)) | (around > F(2))); }
};

HWY_INLINE ShapeLanes in_all_lanes(const ViewShape& shape) {
    ShapeLanes lanes;
    for (int i = 0; i < 3; ++i)
        lanes.row[i] = {F(shape.to_unit[i][0]), F(shape.to_unit[i][1]), F(shape.to_unit[i][2])};
    lanes.along = F(shape.along);
    lanes.around = F(shape.around);
    return lanes;
}

// How far a point is out: N = ((|x|^n2 + |y|^n2)^(n1/n2) + |z|^n1)^(1/n1), 1 on the surface. N is a convex
// function. gradient: its derivatives.
struct Reach {
    F size;
    Triple<F> gradient;
};
HWY_INLINE Reach reach_of(const Triple<F>& p, const ShapeLanes& shape) {
    const F least(1e-6);  // keeps logarithms finite
    const auto away_from_zero = [&](F a) { return select(a < F(0), smaller(a, -least), larger(a, least)); };
    const F x = away_from_zero(p.x), y = away_from_zero(p.y), z = away_from_zero(p.z);
    const F part_x = exponential(shape.around * logarithm(size_of(x)));
    const F part_y = exponential(shape.around * logarithm(size_of(y)));
    const F part_z = exponential(shape.along * logarithm(size_of(z)));
    const F level = larger(part_x + part_y, F(1e-30));
    const F ring = exponential(shape.along / shape.around * logarithm(level));
    const F sum = larger(ring + part_z, F(1e-30));
    const F size = exponential(logarithm(sum) / shape.along);
    const F all = size / sum, around = all * ring / level;
    return {size, {around * part_x / x, around * part_y / y, all * part_z / z}};
}

// Moves `place`, a point of the line closest + place * along outside of the shape, to where the line meets
// it. side: 1 if the point comes before the shape, -1 if after it. Gives the lanes whose line misses.
HWY_INLINE F::Mask approach(const Triple<F>& closest, const Triple<F>& along, const ShapeLanes& shape, F side,
                            F& place) {
    constexpr int kSteps = 14;
    constexpr float kTouch = 1e-3f;  // of the half lengths: a line that passes nearer touches
    auto lost = F(1) < F(0);
    F left(1);
    for (int step = 0; step < kSteps; ++step) {
        const Reach reach = reach_of(closest.plus(along, place), shape);
        left = reach.size - F(1);
        const F slope = side * reach.gradient.dot(along);
        const auto outside = left > F(0);
        lost = lost | (outside & (slope > F(-1e-12)) & (left > F(kTouch)));
        const auto moves = outside & (slope < F(-1e-12));
        place += select(moves, side * left / larger(-slope, F(1e-12)), F(0));
    }
    return lost | (left > F(kTouch));
}

template <bool orthographic>
HWY_INLINE Meeting meet(const Ray<orthographic>& ray, F x, F y, F z, const ShapeLanes& shape) {
    const Triple<F> direction{orthographic ? F(0) : ray.x, orthographic ? F(0) : ray.y, F(1)};
    const F near = orthographic ? z : multiply_add(x, ray.x, multiply_add(y, ray.y, z)) * ray.inverse;
    const Triple<F> centre{x, y, z};
    const Triple<F> past = orthographic ? Triple<F>{ray.x - x, ray.y - y, F(0)} : direction * near - centre;
    const Triple<F> from = shape.unit(past), along = shape.unit(direction);
    const F inverse = F(1) / along.squared();
    F shift = -(from.dot(along)) * inverse;
    const Triple<F> closest = from.plus(along, shift);
    Meeting m;
    m.rest = F(1) - closest.squared();
    m.half = root(larger(m.rest, F(0)) * inverse);
    if (!shape.all_ellipsoids()) {
        // All of the shape lies within the cube of half lengths, and so within a ball of radius root(3).
        const F room = (F(3) - closest.squared()) * inverse, end = root(larger(room, F(0)));
        F entry = -end, exit = end;
        auto lost = approach(closest, along, shape, F(1), entry);
        lost = lost | approach(closest, along, shape, F(-1), exit) | (room < F(0));
        const auto block = (shape.along > F(2)) | (shape.around > F(2));
        const auto hit = exit > entry;
        m.rest = select(block, select(lost, F(-1), select(hit, F(1), F(-1))), m.rest);
        const F middle = F(0.5) * (entry + exit);
        m.half = select(block, larger(F(0.5) * (exit - entry), F(0)), m.half);
        shift += select(block, select(m.rest > F(0), middle, F(0)), F(0));
    }
    m.along = near + shift;
    m.miss = past.plus(direction, shift);
    return m;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
