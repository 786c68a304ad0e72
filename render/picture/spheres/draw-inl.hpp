// Draws spheres into arrays of depth and number, pixel by pixel, and marks the pixels of a row where numbers
// change. These pixels lie on edges. For each of them it finds which grains share it and how large their
// shares are, in eighths: lines of sight through eight points of the pixel are met with all grains that may
// be seen in it. So silhouettes and lines of intersection are exact at these points.
#if defined(GRAINREEL_SPHERES_DRAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_DRAW_INL
#undef GRAINREEL_SPHERES_DRAW_INL
#else
#define GRAINREEL_SPHERES_DRAW_INL
#endif

#include <cstring>

#include "render/picture/spheres/meet-inl.hpp"
#include "render/picture/spheres/meet_shape-inl.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

using Numbers = hn::Rebind<std::uint32_t, Floats>;

HWY_INLINE void keep_nearer(F away, std::uint32_t number, float* depth, std::uint32_t* seen) {
    const F before = load_any(depth);
    const auto nearer = away < before;
    if (none(nearer)) return;
    store_any(select(nearer, away, before), depth);
    const auto old = hn::LoadU(Numbers(), seen);
    const auto mask = hn::RebindMask(Numbers(), nearer.bits);
    hn::StoreU(hn::IfThenElse(mask, hn::Set(Numbers(), number), old), Numbers(), seen);
}

// form: the radius of a sphere, or a shape.
template <bool orthographic, bool cut_open, class Form>
void draw_as(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& s, const Form& form,
             const PixelBox& box, std::uint32_t number) {
    const F x(s.x), y(s.y), z(s.z);
    for (int row = box.y0; row < box.y1; ++row) {
        const F slope_y(sight.slope_y(static_cast<float>(row) + 0.5f));
        const std::size_t first = static_cast<std::size_t>(row - rows.first_row) * rows.stride;
        for (int at = box.x0; at < box.x1; at += F::count) {
            const Ray<orthographic> ray(load_any(rows.slope_x + at), slope_y);
            const F away = seen_of<cut_open>(ray, cut, meet<orthographic>(ray, x, y, z, form));
            keep_nearer(away, number, rows.depth + first + at, rows.seen + first + at);
        }
    }
}

template <class Form>
void draw_form(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& s,
               const Form& form, const PixelBox& box, std::uint32_t number) {
    if (sight.orthographic)
        (cut.planes ? draw_as<true, true, Form> : draw_as<true, false, Form>)(sight, cut, rows, s, form, box,
                                                                              number);
    else
        (cut.planes ? draw_as<false, true, Form> : draw_as<false, false, Form>)(sight, cut, rows, s, form,
                                                                                box, number);
}

void draw(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& s, const PixelBox& box,
          std::uint32_t number) {
    draw_form(sight, cut, rows, s, F(s.radius), box, number);
}

void draw_shape(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& around,
                const ViewShape& shape, const PixelBox& box, std::uint32_t number) {
    draw_form(sight, cut, rows, around, in_all_lanes(shape), box, number);
}

float farthest(const DepthRows& rows, const PixelBox& box) {
    F most(0);
    float last = 0;
    for (int row = box.y0; row < box.y1; ++row) {
        const float* depth = rows.depth + static_cast<std::size_t>(row - rows.first_row) * rows.stride;
        int at = box.x0;
        for (; at + F::count <= box.x1; at += F::count) most = larger(most, load_any(depth + at));
        for (; at < box.x1; ++at) last = std::max(last, depth[at]);
    }
    return std::max(last, hn::GetLane(hn::MaxOfLanes(Floats(), most.value)));
}

// differs(d, at) gives a register with a lane for each pixel from `at` on; pixels whose lane is not 0 are
// marked. Bits past the end of the row are 0.
template <class Differs>
HWY_INLINE void mark(int count, std::uint64_t* bits, const Differs& differs) {
    const hn::CappedTag<std::uint32_t, 16> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int first = 0; first < count; first += 64) {
        std::uint64_t word = 0;
        for (int part = 0; part < 64 && first + part < count; part += lanes) {
            std::uint8_t some[8] = {};
            hn::StoreMaskBits(d, hn::Ne(differs(d, first + part), hn::Zero(d)), some);
            std::uint64_t few = 0;
            std::memcpy(&few, some, sizeof few);
            word |= few << part;
        }
        const int left = count - first;
        bits[first / 64] = left < 64 ? word & ((std::uint64_t{1} << left) - 1) : word;
    }
}

void mark_changes(const std::uint32_t* row, int count, std::uint64_t* bits) {
    mark(count, bits,
         [&](auto d, int at) { return hn::Xor(hn::LoadU(d, row + at), hn::LoadU(d, row + at - 1)); });
}

void mark_edges(const std::uint32_t* row, const std::uint32_t* above, const std::uint32_t* below, int count,
                std::uint64_t* bits) {
    mark(count, bits, [&](auto d, int at) {
        const auto own = hn::LoadU(d, row + at);
        const auto differs = [&](const std::uint32_t* other) {
            return hn::Xor(own, hn::LoadU(d, other + at));
        };
        return hn::Or(hn::Or(differs(row - 1), differs(row + 1)), hn::Or(differs(above), differs(below)));
    });
}

// From here on: how grains share the pixels on edges.

constexpr ViewShape kUnitBall{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

HWY_INLINE F candidate_part(const ViewSphere* spheres, float ViewSphere::*part) {
    alignas(64) float values[kPointBlock];
    for (int i = 0; i < F::count; ++i) values[i] = spheres[i].*part;
    return load<F>(values);
}

// The shapes of F::count candidates; those that are missing are unit balls.
HWY_INLINE ShapeLanes candidate_shapes(const ViewShape* const* shapes) {
    alignas(64) float part[11][kPointBlock];
    for (int i = 0; i < F::count; ++i) {
        const ViewShape& shape = shapes[i] ? *shapes[i] : kUnitBall;
        for (int k = 0; k < 9; ++k) part[k][i] = shape.to_unit[k / 3][k % 3];
        part[9][i] = shape.along, part[10][i] = shape.around;
    }
    ShapeLanes lanes;
    for (int k = 0; k < 3; ++k)
        lanes.row[k] = {load<F>(part[3 * k]), load<F>(part[3 * k + 1]), load<F>(part[3 * k + 2])};
    lanes.along = load<F>(part[9]);
    lanes.around = load<F>(part[10]);
    return lanes;
}

template <bool orthographic, bool cut_open, bool shaped>
void settle_part(const Sight& sight, const Cut& cut, EdgeBlock& block, int first) {
    const F x = load<F>(block.x + first), y = load<F>(block.y + first), scale(1 / sight.focal);
    F nearest[kPoints], owner[kPoints];
    for (int p = 0; p < kPoints; ++p) nearest[p] = F(kNoGrain), owner[p] = F(-1);
    for (int c = 0; c < block.candidates; ++c) {
        const ViewSphere* who = block.candidate[c] + first;
        const F cx = candidate_part(who, &ViewSphere::x), cy = candidate_part(who, &ViewSphere::y);
        const F cz = candidate_part(who, &ViewSphere::z), cr = candidate_part(who, &ViewSphere::radius);
        const auto there = cr > F(0);
        const auto form = [&] {
            if constexpr (shaped)
                return candidate_shapes(block.shape[c] + first);
            else
                return cr;
        }();
        for (int p = 0; p < kPoints; ++p) {
            const Ray<orthographic> ray((x + F(kPointX[p] / 16) - F(sight.centre_x)) * scale,
                                        (F(sight.centre_y) - y - F(kPointY[p] / 16)) * scale);
            const F away = seen_of<cut_open>(ray, cut, meet<orthographic>(ray, cx, cy, cz, form));
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

template <bool shaped>
void settle_block(const Sight& sight, const Cut& cut, EdgeBlock& block) {
    for (int first = 0; first < kPointBlock; first += F::count) {
        if (sight.orthographic)
            (cut.planes ? settle_part<true, true, shaped> : settle_part<true, false, shaped>)(sight, cut,
                                                                                              block, first);
        else
            (cut.planes ? settle_part<false, true, shaped> : settle_part<false, false, shaped>)(sight, cut,
                                                                                                block, first);
    }
}

void settle(const Sight& sight, const Cut& cut, EdgeBlock& block) {
    settle_block<false>(sight, cut, block);
}

void settle_shapes(const Sight& sight, const Cut& cut, EdgeBlock& block) {
    settle_block<true>(sight, cut, block);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
