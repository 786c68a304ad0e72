// Draws spheres into depth and number, pixel by pixel, and marks the pixels of a row where numbers change.
#if defined(GRAINREEL_SPHERES_DRAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_SPHERES_DRAW_INL
#undef GRAINREEL_SPHERES_DRAW_INL
#else
#define GRAINREEL_SPHERES_DRAW_INL
#endif

#include <cstring>

#include "render/picture/spheres/meet-inl.hpp"
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

template <bool orthographic, bool cut_open>
void draw_as(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& s,
             const PixelBox& box, std::uint32_t number) {
    const F x(s.x), y(s.y), z(s.z), radius(s.radius);
    for (int row = box.y0; row < box.y1; ++row) {
        const F slope_y(sight.slope_y(static_cast<float>(row) + 0.5f));
        const std::size_t first = static_cast<std::size_t>(row - rows.first_row) * rows.stride;
        for (int at = box.x0; at < box.x1; at += F::count) {
            const Ray<orthographic> ray(load_any(rows.slope_x + at), slope_y);
            const F away = seen_of<cut_open>(ray, cut, meet<orthographic>(ray, x, y, z, radius));
            keep_nearer(away, number, rows.depth + first + at, rows.seen + first + at);
        }
    }
}

void draw(const Sight& sight, const Cut& cut, const DepthRows& rows, const ViewSphere& s, const PixelBox& box,
          std::uint32_t number) {
    if (sight.orthographic)
        (cut.planes ? draw_as<true, true> : draw_as<true, false>)(sight, cut, rows, s, box, number);
    else
        (cut.planes ? draw_as<false, true> : draw_as<false, false>)(sight, cut, rows, s, box, number);
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

// differs(at) gives lanes for the pixels from `at` on; pixels whose lane is not 0 are marked. Bits past the
// end of the row are 0.
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

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
