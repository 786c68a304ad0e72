// Finds which grains share a pixel on an edge, and how large their shares are. All grains that may be seen in
// the pixel are met at eight points in it. So silhouettes and lines of intersection are exact, and smooth to
// an eighth.
#if defined(GRAINREEL_SPHERES_SETTLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_SETTLE_INL
#undef GRAINREEL_SPHERES_SETTLE_INL
#else
#define GRAINREEL_SPHERES_SETTLE_INL
#endif

#include "render/picture/spheres/draw-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE F candidate_part(const ViewSphere* spheres, float ViewSphere::*part) {
    alignas(64) float values[kPointBlock];
    for (int i = 0; i < F::count; ++i) values[i] = spheres[i].*part;
    return load<F>(values);
}

template <bool orthographic, bool cut_open>
void settle_part(const Sight& sight, const Cut& cut, EdgeBlock& block, int first) {
    const F x = load<F>(block.x + first), y = load<F>(block.y + first), scale(1 / sight.focal);
    F nearest[kPoints], owner[kPoints];
    for (int p = 0; p < kPoints; ++p) nearest[p] = F(kNoGrain), owner[p] = F(-1);
    for (int c = 0; c < block.candidates; ++c) {
        const ViewSphere* who = block.candidate[c] + first;
        const F cx = candidate_part(who, &ViewSphere::x), cy = candidate_part(who, &ViewSphere::y);
        const F cz = candidate_part(who, &ViewSphere::z), cr = candidate_part(who, &ViewSphere::radius);
        const auto there = cr > F(0);
        for (int p = 0; p < kPoints; ++p) {
            const Ray<orthographic> ray((x + F(kPointX[p] / 16) - F(sight.centre_x)) * scale,
                                        (F(sight.centre_y) - y - F(kPointY[p] / 16)) * scale);
            const F away = seen_of<cut_open>(ray, cut, meet<orthographic>(ray, cx, cy, cz, cr));
            const auto nearer = there & (away < nearest[p]);
            nearest[p] = select(nearer, away, nearest[p]);
            owner[p] = select(nearer, F(static_cast<float>(c)), owner[p]);
        }
    }
    for (int p = 0; p < kPoints; ++p) store(nearest[p], block.nearest[p] + first);
    for (int c = 0; c < block.candidates; ++c) {
        F hits(0), sum_x(0), sum_y(0);
        for (int p = 0; p < kPoints; ++p) {
            const F one = select(owner[p] == F(static_cast<float>(c)), F(1), F(0));
            hits += one;
            sum_x = multiply_add(one, F(kPointX[p] / 16), sum_x);
            sum_y = multiply_add(one, F(kPointY[p] / 16), sum_y);
        }
        const F inverse = F(1) / larger(hits, F(1));
        store(hits * F(1.0f / kPoints), block.share[c] + first);
        store(sum_x * inverse, block.mean_x[c] + first);
        store(sum_y * inverse, block.mean_y[c] + first);
    }
}

void settle(const Sight& sight, const Cut& cut, EdgeBlock& block) {
    for (int first = 0; first < kPointBlock; first += F::count) {
        if (sight.orthographic)
            (cut.planes ? settle_part<true, true> : settle_part<true, false>)(sight, cut, block, first);
        else
            (cut.planes ? settle_part<false, true> : settle_part<false, false>)(sight, cut, block, first);
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
