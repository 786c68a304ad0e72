// Computes how much of its light a wall keeps beside grains and other walls.
#if defined(GRAINREEL_SPHERES_WALL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_WALL_INL
#undef GRAINREEL_SPHERES_WALL_INL
#else
#define GRAINREEL_SPHERES_WALL_INL
#endif

#include "render/picture/spheres/light/light-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// The share of the light from all around that grains leave to a wall. It is that of openness(), with a fade
// that goes by the point's own distance x from the grain's centre, in parts of the grain's reach:
// (1 - x^4)^2, and kFoot so that the foot of a grain is black.
HWY_INLINE F wall_openness(const SurfacePoint& point, const NeighbourSpan& neighbours) {
    constexpr float kReach = 3,
                    kAtFoot = 1 - 1 / (kReach * kReach * kReach * kReach);  // radii, from the centre
    constexpr float kFoot = 1 / (kAtFoot * kAtFoot);
    F open(1);
    for (int i = 0; i < neighbours.count; ++i) {
        const NearGrain& n = neighbours.first[i];
        const Triple<F> to{F(n.x) - point.at.x, F(n.y) - point.at.y, F(n.z) - point.at.z};
        const F squared = to.squared();
        const F far = squared * F(n.inverse_radius * n.inverse_radius / (kReach * kReach));
        const F rise = point.normal.dot(to);
        if (none((far < F(1)) & (rise > F(-n.radius)))) continue;
        const F inverse = inverse_root(squared);
        const F share = smaller(F(n.square) * inverse * inverse, F(1));
        const F sunk = rise * F(n.inverse_radius);
        const F whole = larger(rise, F(0)) * inverse * share;
        const F base = zero_to_one(F(0.5) * (sunk + F(1)) * share);
        const F part = base * base * inverse_root(larger(base, F(1e-12)));
        const F left = larger(less_product(F(1), far, far), F(0));
        const F fade = F(kFoot * n.weight) * left * left;
        open *= larger(less_product(F(1), fade, select(size_of(sunk) < F(1), part, whole)), F(0));
    }
    return open;
}

// The share of the lamp that grains leave to a wall. Lamp and grain are discs of radius s and r, seen from
// the point, whose middles are d apart. What they share goes from all of the smaller one at d = |s - r| to
// nothing at d = s + r, nearly as a smooth step does.
HWY_INLINE F wall_lit(const SurfacePoint& point, const Lamp& lamp, const NeighbourSpan& neighbours) {
    constexpr float kLeast = 0.02f;  // radii, so that edges are not jagged where a grain touches the wall
    F lit(1);
    const Triple<F> key{F(lamp.to_key[0]), F(lamp.to_key[1]), F(lamp.to_key[2])};
    for (int i = 0; i < neighbours.count; ++i) {
        const NearGrain& n = neighbours.first[i];
        const Triple<F> to{F(n.x) - point.at.x, F(n.y) - point.at.y, F(n.z) - point.at.z};
        const F ahead = to.dot(key);
        const F squared = larger(less_product(to.squared(), ahead, ahead), F(1e-20));
        const F r(n.radius), s = multiply_add(larger(ahead, F(0)), F(lamp.spread), F(kLeast * n.radius));
        const auto meets = (ahead > F(0)) & (squared < (r + s) * (r + s));
        if (none(meets)) continue;
        const F t =
            zero_to_one((r + s - squared * inverse_root(squared)) * F(0.5) * inverse_of(smaller(r, s)));
        const F part = r * inverse_of(s);
        const F hidden = smaller(part * part, F(1)) * t * t * less_product(F(3), F(2), t);
        lit *= select(meets, less_product(F(1), F(n.weight), hidden), F(1));
        if (none(lit > F(1e-3))) break;
    }
    return lit;
}

// The share of the light from all around that other walls of the container leave. A wall as high as
// `reach` at the distance d takes (1 - d / root(d^2 + reach^2)) / 2, if it is long. kTaken: what such a wall
// takes and does not send back.
HWY_INLINE F corner_openness(const SurfacePoint& point, F wall, F container, const WallShade& shade) {
    constexpr float kTaken = 0.75f;
    F open(1);
    for (int i = 0; i < shade.corners;) {
        const CornerPlane& first = shade.corner[i];
        F nearest(1e30f);
        for (; i < shade.corners && shade.corner[i].wall == first.wall &&
               shade.corner[i].container == first.container;
             ++i) {
            const CornerPlane& p = shade.corner[i];
            nearest = smaller(nearest, point.at.dot(Triple<F>{F(p.x), F(p.y), F(p.z)}) - F(p.d));
        }
        const auto other = differ(wall == F(first.wall), container == container);
        const F d = larger(nearest, F(0));
        const F away = d * inverse_root(multiply_add(d, d, F(shade.corner_reach * shade.corner_reach)));
        const F taken = F(0.5f * kTaken * first.taken) * (F(1) - away);
        open *= select(other & (container == F(first.container)), F(1) - taken, F(1));
    }
    return open;
}

template <bool orthographic>
void light_wall_as(const Sight& sight, const Lamp& lamp, const WallShade& shade, WallRow& row) {
    constexpr float kLeast = 0.09f;  // share of its light that a wall keeps everywhere
    const Triple<F> key{F(lamp.to_key[0]), F(lamp.to_key[1]), F(lamp.to_key[2])};
    const Triple<F> up{F(lamp.up[0]), F(lamp.up[1]), F(lamp.up[2])};
    const F scale(1 / sight.focal);
    for (int first = 0; first < kWallRow; first += F::count) {
        const F taken = load<F>(row.taken + first);
        if (none(taken > F(0))) {
            store(F(1), row.share + first);
            continue;
        }
        const F iota = hn::Iota(Floats(), 0.0f);
        const F x = (iota + F(row.x + static_cast<float>(first) - sight.centre_x)) * scale;
        const F y = F(sight.centre_y - row.y) * scale, z = load<F>(row.away + first);
        SurfacePoint point;
        point.at = {(orthographic ? x : x * z) - F(shade.origin[0]),
                    (orthographic ? y : y * z) - F(shade.origin[1]), z - F(shade.origin[2])};
        point.normal = {load<F>(row.normal[0] + first), load<F>(row.normal[1] + first),
                        load<F>(row.normal[2] + first)};
        F open(1), lit(1);
        if (lamp.occlusion) {
            open = wall_openness(point, shade.occluders);
            open *= corner_openness(point, load<F>(row.wall + first), load<F>(row.container + first), shade);
        }
        const F falls = F(lamp.key) * larger(point.normal.dot(key), F(0));
        if (shade.casters.count > 0 && !none(falls > F(0))) lit = wall_lit(point, lamp, shade.casters);
        const F sky = multiply_add(point.normal.dot(up), F(0.5), F(0.5));
        const F ambient = multiply_add(sky, F(lamp.sky - lamp.ground), F(lamp.ground));
        const F left = multiply_add(ambient, open, falls * lit) / (ambient + falls);
        // The root turns shares of light into shares of what the eye, and sRGB, make of it.
        const F share = load<F>(row.tone + first) * root(larger(left, F(kLeast)));
        store(less_product(F(1), taken, F(1) - share), row.share + first);
    }
}

void light_wall(const Sight& sight, const Lamp& lamp, const WallShade& shade, WallRow& row) {
    (sight.orthographic ? light_wall_as<true> : light_wall_as<false>)(sight, lamp, shade, row);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
