// Computes the light that points on one grain send to the eye.
#if defined(GRAINREEL_SPHERES_LIGHT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_LIGHT_INL
#undef GRAINREEL_SPHERES_LIGHT_INL
#else
#define GRAINREEL_SPHERES_LIGHT_INL
#endif

#include "render/picture/spheres/draw-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// A point that is seen, as a vector from the grain's centre, with its normal and the direction to the eye.
struct SurfacePoint {
    Triple<F> at, normal, to_eye;
    F cap;  // 1 on a cut face, else 0
};

// Which way a point of the surface faces; `point` counts from the centre.
HWY_INLINE Triple<F> facing(const Triple<F>& point, F radius) {
    return point * (F(1) / radius);
}
HWY_INLINE Triple<F> facing(const Triple<F>& point, const ShapeLanes& shape) {
    const Triple<F> own = shape.unit(point);
    return shape.normal(shape.all_ellipsoids() ? own : reach_of(own, shape).gradient);
}

// form: the radius of a sphere, or a shape.
template <bool orthographic, class Form>
HWY_INLINE SurfacePoint surface_point(const Sight& sight, const Cut& cut, const ViewSphere& s,
                                      const Form& form, F pixel_x, F pixel_y) {
    const F scale(1 / sight.focal);
    const Ray<orthographic> ray((pixel_x - F(sight.centre_x)) * scale, (F(sight.centre_y) - pixel_y) * scale);
    const Meeting m = meet<orthographic>(ray, F(s.x), F(s.y), F(s.z), form);
    const Triple<F> direction{orthographic ? F(0) : ray.x, orthographic ? F(0) : ray.y, F(1)};
    F away = seen_at<orthographic>(m);
    SurfacePoint point;
    point.cap = F(0);
    Triple<F> face{F(0), F(0), F(0)};
    if (cut.planes > 0) {
        const Kept k = kept<orthographic>(ray, cut);
        away = seen_at<orthographic>(m, k);
        for (int i = 0; i < cut.planes; ++i) {
            const Cut::Plane& p = cut.plane[i];
            const auto on = (k.plane == F(static_cast<float>(i))) & (m.along - m.half < k.low);
            point.cap = select(on, F(1), point.cap);
            face = select(on, Triple<F>{F(-p.x), F(-p.y), F(-p.z)}, face);
        }
    }
    // A point whose line of sight just misses the grain lies on the silhouette.
    const F back = select(away == F(kNowhere), F(0), away - m.along);
    point.at = m.miss.plus(direction, back);
    point.normal = select(point.cap > F(0), face, facing(point.at, form));
    point.to_eye = -(direction * inverse_root(ray.square));
    return point;
}

// The share of the light from all around, weighted by the cosine, that no neighbour takes. The share that one
// sphere takes is exact if the sphere is wholly above the horizon. It is approximate if the sphere reaches
// below the horizon, or if several spheres overlap (after I. Quilez, "sphere ambient occlusion").
HWY_INLINE F openness(const SurfacePoint& point, const NeighbourSpan& neighbours) {
    F open(1);
    for (int i = 0; i < neighbours.count; ++i) {
        const NearGrain& n = neighbours.first[i];
        const Triple<F> to{F(n.x) - point.at.x, F(n.y) - point.at.y, F(n.z) - point.at.z};
        const F rise = point.normal.dot(to);
        if (none(rise > F(-n.radius))) continue;  // below the horizon
        const F inverse = inverse_root(to.squared());
        // share: the square of the sine of the sphere's angular radius, seen from the point.
        const F share = smaller(F(n.square) * inverse * inverse, F(1));
        const F sunk = rise * F(n.inverse_radius);  // from -1 to 1 the horizon cuts the sphere
        const F whole = larger(rise, F(0)) * inverse * share;
        const F base = zero_to_one(F(0.5) * (sunk + F(1)) * share);
        const F part = base * base * inverse_root(larger(base, F(1e-12)));
        const F taken = select(size_of(sunk) < F(1), part, whole);
        open *= larger(less_product(F(1), F(n.weight), taken), F(0));
    }
    return open;
}

// The share of the key light that comes past the neighbours. Each neighbour hides the part of the lamp's disc
// that its silhouette covers.
HWY_INLINE F unshadowed(const SurfacePoint& point, const Lamp& lamp, const NeighbourSpan& neighbours) {
    F lit(1);
    const Triple<F> key{F(lamp.to_key[0]), F(lamp.to_key[1]), F(lamp.to_key[2])};
    for (int i = 0; i < neighbours.count; ++i) {
        const NearGrain& n = neighbours.first[i];
        const Triple<F> to{F(n.x) - point.at.x, F(n.y) - point.at.y, F(n.z) - point.at.z};
        const F ahead = to.dot(key);
        const F beside = less_product(to.squared(), ahead, ahead);  // squared distance from the light's way
        const F soft =
            multiply_add(larger(ahead, F(0)), F(2 * lamp.spread), F(0.04f * n.radius)) * F(n.radius);
        const F t = zero_to_one(multiply_add((beside - F(n.square)) * inverse_of(soft), F(0.5), F(0.5)));
        const F hidden = F(1) - t * t * less_product(F(3), F(2), t);
        lit *= select(ahead > F(0), less_product(F(1), F(n.weight), hidden), F(1));
        if (none(lit > F(1e-3))) break;
    }
    return lit;
}

// The balls of the legend have the same formula (lit() in render/picture/words/legend_block.cpp): change
// both.
template <bool orthographic, class Form>
void light_as(const Sight& sight, const Cut& cut, const Lamp& lamp, const LitGrain& grain, const Form& form,
              const LitPoints& points) {
    const Triple<F> key{F(lamp.to_key[0]), F(lamp.to_key[1]), F(lamp.to_key[2])};
    const Triple<F> up{F(lamp.up[0]), F(lamp.up[1]), F(lamp.up[2])};
    const Triple<F> pole{F(grain.pole[0]), F(grain.pole[1]), F(grain.pole[2])};
    const bool two_tone = grain.pole[0] != 0 || grain.pole[1] != 0 || grain.pole[2] != 0;
    for (int first = 0; first < points.count; first += F::count) {
        const SurfacePoint p = surface_point<orthographic>(
            sight, cut, grain.sphere, form, load_any(points.x + first), load_any(points.y + first));
        const F open = openness(p, grain.occluders);
        F falls = larger(p.normal.dot(key), F(0));
        F shine(0);
        if (!none(falls > F(0))) {
            falls *= unshadowed(p, lamp, grain.casters);
            const Triple<F> halfway = key + p.to_eye;
            const F gloss = larger(p.normal.dot(halfway), F(0)) * inverse_root(halfway.squared());
            F power = gloss * gloss;  // squared four more times: the 32nd power
            power *= power, power *= power, power *= power, power *= power;
            shine = F(lamp.shine) * power * smaller(falls * F(4), F(1)) * (F(1) - p.cap);
        }
        const F sky = multiply_add(p.normal.dot(up), F(0.5), F(0.5));
        const F ambient =
            multiply_add(multiply_add(sky, F(lamp.sky - lamp.ground), F(lamp.ground)), open, F(lamp.even));
        const F t = zero_to_one(size_of(p.normal.dot(p.to_eye)) * F(1 / lamp.rim_width));
        const F edge = multiply_add(t * t * less_product(F(3), F(2), t), F(1 - lamp.rim), F(lamp.rim));
        F light = multiply_add(falls, F(lamp.key), ambient) * edge;
        light *= select(p.cap > F(0), F(lamp.cap), F(1));
        if (two_tone) {
            const F side = zero_to_one(multiply_add(p.at.dot(pole), F(8 / grain.sphere.radius), F(0.5)));
            light *= multiply_add(side, F(1 - lamp.tone), F(lamp.tone));
        }
        store_any(multiply_add(light, F(grain.albedo[0]), shine), points.red + first);
        store_any(multiply_add(light, F(grain.albedo[1]), shine), points.green + first);
        store_any(multiply_add(light, F(grain.albedo[2]), shine), points.blue + first);
    }
}

template <class Form>
void light_form(const Sight& sight, const Cut& cut, const Lamp& lamp, const LitGrain& grain, const Form& form,
                const LitPoints& points) {
    (sight.orthographic ? light_as<true, Form> : light_as<false, Form>)(sight, cut, lamp, grain, form,
                                                                        points);
}

void light(const Sight& sight, const Cut& cut, const Lamp& lamp, const LitGrain& grain,
           const LitPoints& points) {
    if (grain.shape)
        light_form(sight, cut, lamp, grain, in_all_lanes(*grain.shape), points);
    else
        light_form(sight, cut, lamp, grain, F(grain.sphere.radius), points);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
