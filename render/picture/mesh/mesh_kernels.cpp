// The hot loops of drawing meshes (mesh_kernels.hpp), compiled for each instruction set. Time them after a
// change.
#include "render/picture/mesh/mesh_kernels.hpp"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/mesh/mesh_kernels.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/lanes-inl.hpp"
#include "render/picture/spheres/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {
namespace {

using F = FloatLanes;
using Mask = F::Mask;
using Bytes = hn::RebindToUnsigned<Floats>;
using Pixels = hn::Vec<Bytes>;

HWY_INLINE F load_any(const float* at) {
    return hn::LoadU(Floats(), at);
}
HWY_INLINE void store_any(F a, float* at) {
    hn::StoreU(a.value, Floats(), at);
}
HWY_INLINE Mask operator|(Mask a, Mask b) {
    return {hn::Or(a.bits, b.bits)};
}
HWY_INLINE F between(F value, float low, float high) {
    return smaller(larger(value, F(low)), F(high));
}

// The pixels of a row that a triangle may touch, within its box.
struct Span {
    int begin, end;
};
Span span_of(const ScreenTriangle& t, int row) {
    float low = static_cast<float>(t.x0), high = static_cast<float>(t.x1);
    if (high - low <= 2 * F::count) return {t.x0, t.x1};
    const float top = static_cast<float>(row);
    for (const ScreenTriangle::Edge& e : t.edge) {
        if (e.a == 0) continue;
        const float slope = -e.b / e.a;
        const float first = e.x + slope * (top - e.y), last = first + slope;
        if (e.a > 0)
            low = std::max(low, std::min(first, last) - 1);
        else
            high = std::min(high, std::max(first, last) + 1);
    }
    if (!(low < high)) return {0, 0};
    return {static_cast<int>(low), std::min(t.x1, static_cast<int>(high) + 1)};
}

// A triangle's edges along one row.
struct EdgeRow {
    F a, x, base;
    HWY_INLINE EdgeRow(const ScreenTriangle::Edge& e, float y) : a(e.a), x(e.x), base(e.b * (y - e.y)) {}
    HWY_INLINE F at(F px) const { return multiply_add(a, px - x, base); }
};

HWY_INLINE F along(const ScreenPlane& plane, const ScreenTriangle& t, F px, float py) {
    return multiply_add(F(plane.x), px - F(t.x), F(plane.at + plane.y * (py - t.y)));
}

HWY_INLINE Pixels colour_of(const ScreenTriangle& t, F shade) {
    const Bytes d;
    const auto byte = [&](int c) {
        const F value = multiply_add(shade, F(t.brighter[c]), F(t.colour[c] + 0.5f));
        return hn::BitCast(d, hn::ConvertTo(hn::RebindToSigned<Floats>(), value.value));
    };
    return hn::Or(hn::Or(byte(0), hn::ShiftLeft<8>(byte(1))),
                  hn::Or(hn::ShiftLeft<16>(byte(2)), hn::Set(d, 0xff000000u)));
}

HWY_INLINE Pixels blend_of(const ScreenTriangle& t, F shade, F px, float py) {
    const Bytes d;
    const F light = multiply_add(shade, F(1 - kDarkColour), F(kDarkColour));
    const auto byte = [&](int c) {
        const F own = between(along(t.own[c], t, px, py), t.own[c].low, t.own[c].high);
        const F value = multiply_add(own, light, F(0.5f));
        return hn::BitCast(d, hn::ConvertTo(hn::RebindToSigned<Floats>(), value.value));
    };
    return hn::Or(hn::Or(byte(0), hn::ShiftLeft<8>(byte(1))),
                  hn::Or(hn::ShiftLeft<16>(byte(2)), hn::Set(d, 0xff000000u)));
}

HWY_INLINE void keep_pixels(Mask which, Pixels pixels, std::uint32_t* at) {
    const Bytes d;
    hn::StoreU(hn::IfThenElse(hn::RebindMask(d, which.bits), pixels, hn::LoadU(d, at)), d, at);
}

// Stores the nearnesses that exceed those at `at`. Returns the lanes that were stored.
HWY_INLINE Mask keep_nearer(Mask inside, F near, float* at) {
    const F before = load_any(at);
    const Mask nearer = inside & (near > before);
    store_any(select(nearer, near, before), at);
    return nearer;
}

void solid(const ScreenTriangle& t, const MeshRows& rows, int y0, int y1) {
    float offset[3][kMeshSamples], near_offset[kMeshSamples];
    for (int s = 0; s < kMeshSamples; ++s) {
        for (int e = 0; e < 3; ++e) offset[e][s] = t.edge[e].a * kSampleX[s] + t.edge[e].b * kSampleY[s];
        near_offset[s] = t.near.x * kSampleX[s] + t.near.y * kSampleY[s];
    }
    const F least[3] = {F(t.edge[0].least), F(t.edge[1].least), F(t.edge[2].least)};
    const F iota = hn::Iota(Floats(), 0.5f);
    for (int row = std::max(t.y0, y0); row < std::min(t.y1, y1); ++row) {
        const Span span = span_of(t, row);
        const float y = static_cast<float>(row) + 0.5f;
        const EdgeRow edge[3] = {{t.edge[0], y}, {t.edge[1], y}, {t.edge[2], y}};
        const std::size_t first = static_cast<std::size_t>(row - rows.first_row) * rows.stride;
        for (int px = span.begin; px < span.end; px += F::count) {
            const F x = iota + F(static_cast<float>(px));
            const std::size_t at = first + static_cast<std::size_t>(px);
            const F e0 = edge[0].at(x), e1 = edge[1].at(x), e2 = edge[2].at(x);
            const auto inside_at = [&](int s) {
                return (e0 + F(offset[0][s]) > least[0]) & (e1 + F(offset[1][s]) > least[1]) &
                       (e2 + F(offset[2][s]) > least[2]);
            };
            const Mask middle = (e0 > least[0]) & (e1 > least[1]) & (e2 > least[2]);
            Mask inside[kMeshSamples];
            Mask any = middle;
            for (int s = 0; s < kMeshSamples; ++s) any = any | (inside[s] = inside_at(s));
            if (none(any)) continue;
            const F near = along(t.near, t, x, y);
            const F shade = between(along(t.shade, t, x, y), t.shade.low, t.shade.high);
            const Pixels colour = t.blended ? blend_of(t, shade, x, y) : colour_of(t, shade);
            const Mask seen =
                keep_nearer(middle, between(near, t.near.low, t.near.high), rows.near_middle + at);
            keep_pixels(seen, hn::Set(Bytes(), t.number), rows.number + at);
            for (int s = 0; s < kMeshSamples; ++s) {
                const F there = between(near + F(near_offset[s]), t.near.low, t.near.high);
                keep_pixels(keep_nearer(inside[s], there, rows.near[s] + at), colour, rows.colour[s] + at);
            }
        }
    }
}

void glass(const ScreenTriangle& t, const GlassRows& rows, int y0, int y1) {
    const F iota = hn::Iota(Floats(), 0.5f);
    for (int row = std::max(t.y0, y0); row < std::min(t.y1, y1); ++row) {
        const Span span = span_of(t, row);
        const float y = static_cast<float>(row) + 0.5f;
        const EdgeRow edge[3] = {{t.edge[0], y}, {t.edge[1], y}, {t.edge[2], y}};
        const auto line = static_cast<std::size_t>(row - rows.first_row);
        for (int px = span.begin; px < span.end; px += F::count) {
            const F x = iota + F(static_cast<float>(px));
            const std::size_t at = line * rows.stride + static_cast<std::size_t>(px);
            const Mask inside = (edge[0].at(x) > F(t.edge[0].least)) & (edge[1].at(x) > F(t.edge[1].least)) &
                                (edge[2].at(x) > F(t.edge[2].least));
            if (none(inside)) continue;
            const F near = between(along(t.near, t, x, y), t.near.low, t.near.high);
            const F behind = load_any(rows.away + line * rows.away_stride + px);
            const Mask before = rows.orthographic ? -near < behind : near * behind > F(1);
            const F thickness = load_any(rows.thickness + at);
            store_any(select(inside & before, thickness + F(t.tint), thickness), rows.thickness + at);
        }
    }
}

HWY_INLINE Pixels mean_of_four(const Pixels (&of)[kMeshSamples]) {
    const Bytes d;
    const Pixels even = hn::Set(d, 0x00ff00ffu), half = hn::Set(d, 0x00020002u);
    Pixels low = half, high = half;
    for (const Pixels& pixels : of) {
        low = hn::Add(low, hn::And(pixels, even));
        high = hn::Add(high, hn::And(hn::ShiftRight<8>(pixels), even));
    }
    return hn::Or(hn::And(hn::ShiftRight<2>(low), even),
                  hn::ShiftLeft<8>(hn::And(hn::ShiftRight<2>(high), even)));
}

void gather(const MeshRows& rows, int row, int x0, int x1, bool orthographic, float apart,
            std::uint32_t* colours, float* away, std::uint64_t* differ) {
    const F nowhere(kNowhereNear);
    const std::size_t first = static_cast<std::size_t>(row - rows.first_row) * rows.stride;
    for (int begin = x0 / 64 * 64; begin < x1; begin += 64) {
        std::uint64_t word = 0;
        for (int px = begin; px < begin + 64 && px < x1; px += F::count) {
            const std::size_t at = first + static_cast<std::size_t>(px);
            Pixels colour[kMeshSamples];
            F nearest = nowhere, farthest = F(std::numeric_limits<float>::infinity());
            for (int s = 0; s < kMeshSamples; ++s) {
                const F near = load_any(rows.near[s] + at);
                colour[s] = hn::LoadU(Bytes(), rows.colour[s] + at);
                nearest = larger(nearest, near);
                farthest = smaller(farthest, near);
            }
            hn::StoreU(mean_of_four(colour), Bytes(), colours + px);
            const F middle = load_any(rows.near_middle + at);
            const F depth = orthographic ? -middle : F(1) / middle;
            store_any(select(middle > nowhere, depth, F(std::numeric_limits<float>::infinity())), away + px);
            const F limit = orthographic ? farthest + F(apart) : farthest * F(1 + apart);
            const Mask unlike = (nearest > nowhere) & (nearest > limit);
            std::uint8_t some[8] = {};
            hn::StoreMaskBits(Floats(), unlike.bits, some);
            std::uint64_t few = 0;
            std::memcpy(&few, some, sizeof few);
            word |= few << (px - begin);
        }
        differ[begin / 64] = word;
    }
}

void tint(const float* thickness, const float* colour, int count, std::uint32_t* pixels) {
    const Bytes d;
    const F red(colour[0]), green(colour[1]), blue(colour[2]);
    for (int px = 0; px < count; px += F::count) {
        const F panes = load_any(thickness + px);
        const Mask some = panes > F(0);
        if (none(some)) continue;
        const F share = panes * F(kPaneShare);
        const F alpha = F(kMostTint) * share / (F(1) + share);
        const auto byte = [&](F value) {
            const F rounded = multiply_add(value, alpha, F(0.5));
            return hn::BitCast(d, hn::ConvertTo(hn::RebindToSigned<Floats>(), rounded.value));
        };
        const Pixels pane = hn::Or(hn::Or(byte(red), hn::ShiftLeft<8>(byte(green))),
                                   hn::Or(hn::ShiftLeft<16>(byte(blue)), hn::ShiftLeft<24>(byte(F(255)))));
        const Pixels below = hn::LoadU(d, pixels + px);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(d, some.bits), over_all(d, pane, below), below), d,
                   pixels + px);
    }
}

}  // namespace

const MeshKernels* mesh_kernels_here() {
    static constexpr MeshKernels kernels{solid, glass, gather, tint};
    return &kernels;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(mesh_kernels_here);

const MeshKernels& mesh_kernels() {
    static const MeshKernels* const best = HWY_DYNAMIC_DISPATCH(mesh_kernels_here)();
    return *best;
}

}  // namespace grainreel
#endif
