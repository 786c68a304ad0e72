// Paints meshes in bands of rows: solid triangles, glass, lines, and pixels that meshes share with grains.
// Hot code.
#include "render/picture/mesh/mesh_painter.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr int kPad = 64;          // numbers after a row that kernels may write to
constexpr float kApart = 3;       // pixels of depth; a grain may lie between samples that are farther apart
constexpr float kOnThePlane = 1;  // pixels by which a line may lie behind a plane and still count as on it

float depth_of(const Sight& sight, float near) {
    return sight.orthographic ? -near : 1 / near;
}

// A quarter of an opaque colour, which is what one sample adds to a pixel.
std::uint32_t quarters(std::uint32_t opaque) {
    return scaled(opaque, 64);
}

std::uint32_t sum_of(std::uint32_t a, std::uint32_t b) {
    std::uint32_t sum = 0;
    for (int shift = 0; shift < 32; shift += 8)
        sum |= std::min(((a >> shift) & 255u) + ((b >> shift) & 255u), 255u) << shift;
    return sum;
}

// The colour that the layer below must have so that `pixel` is seen of it when the layer above covers the
// share taken/255.
std::uint32_t in_the_rest(std::uint32_t pixel, std::uint32_t taken) {
    if (taken >= 255) return 0;
    std::uint32_t out = 0;
    for (int shift = 0; shift < 32; shift += 8)
        out |= std::min(((pixel >> shift) & 255u) * 255 / (255 - taken), 255u) << shift;
    return out;
}

std::uint32_t packed(const std::array<float, 3>& colour, std::uint32_t alpha) {
    std::uint32_t opaque = 0xff000000u;
    for (int c = 0; c < 3; ++c) opaque |= static_cast<std::uint32_t>(std::lround(colour[c])) << (8 * c);
    return scaled(opaque, alpha);
}

void replace_row(Layer& layer, int y, const std::uint32_t* row, int x0, int x1) {
    Layer::Span& span = layer.spans[y];
    std::uint32_t* out = layer.row(y);
    std::fill(out + span.begin, out + span.end, 0u);
    span = x0 < x1 ? Layer::Span{x0, x1} : Layer::Span{};
    if (x0 < x1) std::copy(row + x0, row + x1, out + x0);
}

}  // namespace

MeshPainter::MeshPainter(int width, int height)
    : width_(width),
      height_(height),
      stride_((static_cast<std::size_t>(width) + 63) / 64 * 64 + kPad),
      behind_(width, height),
      before_(width, height),
      away_(stride_ * static_cast<std::size_t>(height), kNothing),
      number_(stride_ * static_cast<std::size_t>(height), 0),
      states_(static_cast<std::size_t>(bands())) {}

void MeshPainter::draw_solid(const MeshProjection& meshes, const Sight& sight, Team& team) {
    workers_.resize(static_cast<std::size_t>(team.size()));
    std::atomic<int> next{0};
    team.run([&](int member) {
        Worker& worker = workers_[member];
        const std::size_t room = kBand * stride_;
        if (worker.row.empty()) {
            for (auto& near : worker.near) near.assign(room, kNowhereNear);
            for (auto& colour : worker.colour) colour.assign(room, 0);
            worker.near_middle.assign(room, kNowhereNear);
            worker.row.assign(stride_, 0);
            worker.glass.assign(room, 0);
            worker.line_behind.assign(room, 0);
            worker.line_before.assign(room, 0);
            worker.bits.assign(stride_ / 64, 0);
        }
        for (int band; (band = next.fetch_add(1, std::memory_order_relaxed)) < bands();)
            draw_solid_band(band, meshes, sight, worker);
    });
}

void MeshPainter::draw_solid_band(int band, const MeshProjection& meshes, const Sight& sight,
                                  Worker& worker) {
    BandState& state = states_[band];
    const int y0 = band * kBand, y1 = std::min(height_, y0 + kBand);
    for (int y = y0; y < y1 && !state.solid.empty(); ++y) {
        std::fill(away_.begin() + static_cast<std::ptrdiff_t>(place(state.solid.x0, y)),
                  away_.begin() + static_cast<std::ptrdiff_t>(place(state.solid.x1, y)), kNothing);
        std::fill(number_.begin() + static_cast<std::ptrdiff_t>(place(state.solid.x0, y)),
                  number_.begin() + static_cast<std::ptrdiff_t>(place(state.solid.x1, y)), 0u);
    }
    state.solid = {};
    state.mixed.clear();
    MeshRows rows{};
    for (int s = 0; s < kMeshSamples; ++s) {
        rows.near[s] = worker.near[s].data();
        rows.colour[s] = worker.colour[s].data();
    }
    rows.near_middle = worker.near_middle.data();
    rows.number = number_.data() + place(0, y0);
    rows.stride = stride_;
    rows.first_row = y0;
    for (const std::uint32_t i : meshes.bands()[band].solid) {
        const ScreenTriangle& t = meshes.solid(i);
        state.solid.take(t.x0, t.x1);
        mesh_kernels().solid(t, rows, y0, y1);
    }
    for (const MeshSection& section : meshes.sections()) {
        if (section.y0 >= y1 || section.y1 <= y0 || section.x0 >= section.x1) continue;
        state.solid.take(section.x0, section.x1);
        fill(section, meshes.section_colour(), rows, y0, y1, worker.crossings);
    }
    const Columns& columns = state.solid;
    const float apart = kApart / sight.focal;
    for (int y = y0; y < y1; ++y) {
        if (columns.empty()) {
            replace_row(behind_, y, nullptr, 0, 0);
            continue;
        }
        mesh_kernels().gather(rows, y, columns.x0, columns.x1, sight.orthographic, apart, worker.row.data(),
                              away_.data() + place(0, y), worker.bits.data());
        replace_row(behind_, y, worker.row.data(), columns.x0, columns.x1);
        take_mixed(y, rows, columns, sight, apart, worker, state.mixed);
        const auto begin = static_cast<std::ptrdiff_t>(place(columns.x0, y - y0)),
                   end = static_cast<std::ptrdiff_t>(place(columns.x1, y - y0));
        for (int s = 0; s < kMeshSamples; ++s) {
            std::fill(worker.near[s].begin() + begin, worker.near[s].begin() + end, kNowhereNear);
            std::fill(worker.colour[s].begin() + begin, worker.colour[s].begin() + end, 0u);
        }
        std::fill(worker.near_middle.begin() + begin, worker.near_middle.begin() + end, kNowhereNear);
    }
}

void MeshPainter::darken(const WallLight& light, Team& team) {
    team.run([&](int member) {
        for (int y = member; y < height_; y += team.size()) light.darken(y, behind_.row(y));
    });
    // Pixels with two surfaces were taken apart before the light was known.
    const auto darker = [](std::uint32_t colour, std::uint32_t share) {
        return (colour & 0xff000000u) | (scaled(colour, share) & 0x00ffffffu);
    };
    for (BandState& state : states_)
        for (Mixed& pixel : state.mixed) {
            const std::uint32_t share = light.row(pixel.y)[pixel.x];
            pixel.near = darker(pixel.near, share), pixel.far = darker(pixel.far, share);
        }
}

// Fills a row of samples from each odd crossing of the outline to the next crossing.
void MeshPainter::fill(const MeshSection& section, std::uint32_t colour, const MeshRows& rows, int y0, int y1,
                       std::vector<float>& crossings) {
    const auto fill_row = [&](int row, float dx, float dy, float* near, std::uint32_t* out,
                              std::uint32_t value) {
        const float y = static_cast<float>(row) + 0.5f + dy;
        crossings.clear();
        for (const MeshSection::Edge& e : section.edges)
            if ((e.y0 <= y) != (e.y1 <= y))
                crossings.push_back(e.x0 + (y - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0));
        std::sort(crossings.begin(), crossings.end());
        const auto first = [&](float x) {  // the pixel whose sample is the first at x or behind
            const float pixel = std::ceil(x - 0.5f - dx);
            return std::clamp(static_cast<int>(std::clamp(pixel, -1e6f, 1e6f)), section.x0, section.x1);
        };
        for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
            for (int px = first(crossings[k]); px < first(crossings[k + 1]); ++px) {
                const float there = section.near.at + section.near.x * (static_cast<float>(px) + 0.5f + dx) +
                                    section.near.y * y;
                if (there <= near[px]) continue;
                near[px] = there;
                out[px] = value;
            }
    };
    for (int row = std::max(y0, section.y0); row < std::min(y1, section.y1); ++row) {
        const std::size_t at = static_cast<std::size_t>(row - rows.first_row) * rows.stride;
        for (int s = 0; s < kMeshSamples; ++s)
            fill_row(row, kSampleX[s], kSampleY[s], rows.near[s] + at, rows.colour[s] + at, colour);
        fill_row(row, 0, 0, rows.near_middle + at, rows.number + at, section.number);
    }
}

void MeshPainter::take_mixed(int y, const MeshRows& rows, const Columns& columns, const Sight& sight,
                             float apart, const Worker& worker, std::vector<Mixed>& mixed) {
    for (int word = columns.x0 / 64; word * 64 < columns.x1; ++word)
        for (std::uint64_t left = worker.bits[word]; left; left &= left - 1) {
            const int x = word * 64 + std::countr_zero(left);
            if (x >= columns.x1) break;
            const std::size_t at = place(x, y - rows.first_row);
            float nearest = kNowhereNear, farthest = kNothing;
            for (const float* near : rows.near) {
                if (near[at] == kNowhereNear) continue;
                nearest = std::max(nearest, near[at]);
                farthest = std::min(farthest, near[at]);
            }
            if (nearest == kNowhereNear) continue;
            const bool stepped = nearest > (sight.orthographic ? farthest + apart : farthest * (1 + apart));
            const float middle = stepped ? 0.5f * (nearest + farthest) : kNowhereNear;
            Mixed pixel{x, y, 0, 0, depth_of(sight, nearest), depth_of(sight, farthest)};
            for (int s = 0; s < kMeshSamples; ++s) {
                if (rows.near[s][at] == kNowhereNear) continue;
                std::uint32_t& part = rows.near[s][at] > middle ? pixel.near : pixel.far;
                part = sum_of(part, quarters(rows.colour[s][at]));
            }
            mixed.push_back(pixel);
        }
}

float MeshPainter::grain_depth(const Visibility& seen, int x, int y) {
    if (seen.row(y)[x] != 0) return seen.depth(y)[x];
    float nearest = kNothing;
    const auto look = [&](int nx, int ny) {
        if (nx < 0 || ny < 0 || nx >= seen.width() || ny >= seen.height() || seen.row(ny)[nx] == 0) return;
        nearest = std::min(nearest, seen.depth(ny)[nx]);
    };
    look(x - 1, y), look(x + 1, y), look(x, y - 1), look(x, y + 1);
    return nearest;
}

bool MeshPainter::hidden_by_solid(const Eigen::Vector3f& at, int x, int y, const Job& job) const {
    const std::uint32_t number = number_[place(x, y)];
    if (number == 0) return false;
    const MeshProjection::Plane& plane = job.meshes.plane(number);
    const float pixel = (job.sight.orthographic ? 1 : at.z()) / job.sight.focal;
    return plane.normal.dot(at) - plane.distance < -kOnThePlane * pixel;
}

// Draws a line. It is round at its ends, so that lines that meet look like one.
void MeshPainter::draw_line(const ScreenLine& line, int y0, int y1, const Job& job, Worker& worker) const {
    const float reach = line.half_width + 0.5f;
    const Eigen::Vector2f from = line.from.head<2>(), along = line.to.head<2>() - from;
    const float square = std::max(along.squaredNorm(), 1e-12f);
    for (int y = y0; y < y1; ++y) {
        const float py = static_cast<float>(y) + 0.5f;
        // The part of the line whose height is in reach of the row.
        float begin = 0, end = 1;
        if (std::abs(along.y()) > 1e-6f) {
            const float a = (py - reach - from.y()) / along.y(), b = (py + reach - from.y()) / along.y();
            begin = std::max(begin, std::min(a, b));
            end = std::min(end, std::max(a, b));
        } else if (std::abs(py - from.y()) > reach) {
            continue;
        }
        if (begin > end) continue;
        const float xa = from.x() + begin * along.x(), xb = from.x() + end * along.x();
        const int x0 =
            static_cast<int>(std::clamp(std::min(xa, xb) - reach, 0.0f, static_cast<float>(width_)));
        const int x1 =
            static_cast<int>(std::clamp(std::max(xa, xb) + reach + 1, 0.0f, static_cast<float>(width_)));
        for (int x = x0; x < x1; ++x) {
            const Eigen::Vector2f p(static_cast<float>(x) + 0.5f, py);
            const float share = std::clamp((p - from).dot(along) / square, 0.0f, 1.0f);
            const float cover = std::min(reach - (p - from - share * along).norm(), 1.0f);
            if (cover <= 0) continue;
            const float near = line.from.z() + share * (line.to.z() - line.from.z());
            const float way = job.sight.orthographic ? share : share * line.to.z() / near;
            const Eigen::Vector3f at = line.view_from + way * (line.view_to - line.view_from);
            if (hidden_by_solid(at, x, y, job)) continue;
            const float grain = grain_depth(job.seen, x, y);
            const bool before = grain == kNothing ? line.glass : at.z() < grain;
            std::uint8_t& strength = (before ? worker.line_before : worker.line_behind)[place(x, y % kBand)];
            strength = std::max(strength, static_cast<std::uint8_t>(255 * cover * line.strength + 0.5f));
        }
    }
}

// Paints solid pixels again where the outline of a grain covers them although the solid is nearer.
void MeshPainter::bring_forward(int y, const Job& job, Worker& worker, const Columns& columns) {
    if (columns.empty()) return;
    const Visibility& seen = job.seen;
    sphere_kernels().mark_edges(seen.row(y), seen.row(std::max(0, y - 1)),
                                seen.row(std::min(y + 1, height_ - 1)), width_, worker.edges.room(width_));
    const std::uint32_t* behind = behind_.row(y);
    for (int x = worker.edges.next(columns.x0); x < columns.x1; x = worker.edges.next(x + 1)) {
        if (behind[x] == 0 || seen.row(y)[x] != 0) continue;
        if (away_[place(x, y)] < grain_depth(seen, x, y)) worker.row[x] = behind[x];
    }
}

void MeshPainter::draw_rest(const MeshProjection& meshes, const Sight& sight, const Visibility& seen,
                            const Inks& inks, Team& team) {
    const Job job{meshes, sight, seen, inks};
    std::atomic<int> next{0};
    team.run([&](int member) {
        for (int band; (band = next.fetch_add(1, std::memory_order_relaxed)) < bands();)
            draw_rest_band(band, job, workers_[member]);
    });
}

void MeshPainter::draw_rest_band(int band, const Job& job, Worker& worker) {
    BandState& state = states_[band];
    const MeshProjection::Band& what = job.meshes.bands()[band];
    const int y0 = band * kBand, y1 = std::min(height_, y0 + kBand);
    Columns columns = state.solid;
    for (const std::uint32_t i : what.glass) {
        const ScreenTriangle& t = job.meshes.glass(i);
        columns.take(t.x0, t.x1);
        const GlassRows rows{job.seen.depth(y0),    worker.glass.data(), job.seen.stride(), stride_, y0,
                             job.sight.orthographic};
        mesh_kernels().glass(t, rows, y0, y1);
    }
    for (const std::uint32_t i : what.lines) {
        const ScreenLine& line = job.meshes.line(i);
        const float wide = line.half_width + 1;
        const auto pixel = [&](float x) {
            return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(width_)));
        };
        columns.take(pixel(std::min(line.from.x(), line.to.x()) - wide),
                     pixel(std::max(line.from.x(), line.to.x()) + wide + 1));
        draw_line(line, y0, y1, job, worker);
    }
    std::size_t mixed = 0;
    for (int y = y0; y < y1; ++y) {
        std::fill(worker.row.begin() + columns.x0, worker.row.begin() + columns.x1, 0u);
        bring_forward(y, job, worker, state.solid);
        for (; mixed < state.mixed.size() && state.mixed[mixed].y == y; ++mixed)
            split_mixed(state.mixed[mixed], job.seen, worker);
        lay_glass_and_lines(y, columns, job.inks, worker);
        replace_row(before_, y, worker.row.data(), columns.x0, columns.x1);
    }
}

// Splits a mixed pixel: the part that is nearer than the grain goes into the layer in front of the grains,
// and the rest goes behind them.
void MeshPainter::split_mixed(const Mixed& pixel, const Visibility& seen, Worker& worker) {
    const float grain = grain_depth(seen, pixel.x, pixel.y);
    if (grain == kNothing || pixel.near_away >= grain) return;
    std::uint32_t& before = worker.row[pixel.x];
    before = pixel.far_away < grain ? sum_of(pixel.near, pixel.far) : pixel.near;
    const std::uint32_t left = pixel.far_away < grain ? 0 : pixel.far;
    behind_.row(pixel.y)[pixel.x] = in_the_rest(left, before >> 24);
}

void MeshPainter::lay_glass_and_lines(int y, const Columns& columns, const Inks& inks, Worker& worker) {
    if (columns.empty()) return;
    const std::size_t first = place(0, y % kBand);
    float* glass = worker.glass.data() + first;
    mesh_kernels().tint(glass + columns.x0, inks.glass.data(), columns.x1 - columns.x0,
                        worker.row.data() + columns.x0);
    std::fill(glass + columns.x0, glass + columns.x1, 0.0f);
    Layer::Span& span = behind_.spans[y];
    std::uint32_t* below = behind_.row(y);
    std::uint8_t *before = worker.line_before.data() + first, *behind = worker.line_behind.data() + first;
    for (int x = columns.x0; x < columns.x1; ++x) {
        if (before[x] != 0) {
            std::uint32_t& pixel = worker.row[x];
            pixel = over(packed(inks.line, before[x]), pixel);
            before[x] = 0;
        }
        if (behind[x] == 0) continue;
        below[x] = over(packed(inks.line, behind[x]), below[x]);
        behind[x] = 0;
        span = span.begin < span.end ? Layer::Span{std::min(span.begin, x), std::max(span.end, x + 1)}
                                     : Layer::Span{x, x + 1};
    }
}

}  // namespace grainreel
