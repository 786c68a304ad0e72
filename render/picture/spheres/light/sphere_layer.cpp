// Lights grains in bands of rows: runs of pixels inside grains, and pixels on edges. Hot code.
#include "render/picture/spheres/light/sphere_layer.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/base/system/processor.hpp"
#include "engine/mesh/room.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/picture/spheres/visibility.hpp"

namespace grainreel {

namespace {

constexpr int kManyNeighbours = 40;  // with more neighbours, pixels consider only the nearest ones

// number: index + 1 of a grain, or 0.
bool paints(const PaintJob& job, std::uint32_t number) {
    return number != 0 && (job.spheres.painted.empty() || job.spheres.painted[number - 1] != 0);
}

}  // namespace

void BandPainter::paint(const PaintJob& job, int y0, int y1, Layer& layer) {
    runs_.clear();
    parts_.clear();
    soft_.clear();
    block_size_ = 0;
    for (int y = y0; y < y1; ++y) paint_row(job, y, layer);
    settle_edges(job);
    light_runs(job, layer);
    light_parts(job);
    encode(layer);
}

void BandPainter::make_room(std::size_t points) {
    if (x_.size() >= points + kPointBlock) return;
    for (auto* room : {&x_, &y_, &red_, &green_, &blue_}) room->resize(2 * points + kPointBlock);
}

// Fills the rest of the last register with points of the grain, since kernels read whole registers.
void BandPainter::pad(std::size_t points) {
    std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(points), kPointBlock, x_[0]);
    std::fill_n(y_.begin() + static_cast<std::ptrdiff_t>(points), kPointBlock, y_[0]);
}

// Finds the runs of pixels between edges, and the edges, in one row.
void BandPainter::paint_row(const PaintJob& job, int y, Layer& layer) {
    const Visibility& seen = job.visibility;
    const std::uint32_t* row = seen.row(y);
    std::uint32_t* out = layer.row(y);
    Layer::Span& span = layer.spans[y];
    std::fill(out + span.begin, out + span.end, 0u);
    span = {layer.width, 0};
    sphere_kernels().mark_edges(row, seen.row(std::max(0, y - 1)),
                                seen.row(std::min(y + 1, seen.height() - 1)), layer.width,
                                edges_.room(layer.width));
    for (int x = 0; x < layer.width;) {
        const int end = edges_.next(x);
        if (end == x) {
            take_edge(job, x++, y);
            span = {std::min(span.begin, x - 1), x};
            continue;
        }
        if (paints(job, row[x])) {
            runs_.push_back({row[x] - 1, x, y, end - x});
            span = {std::min(span.begin, x), end};
        }
        x = end;
    }
    if (span.begin > span.end) span = {};
}

void BandPainter::take_edge(const PaintJob& job, int x, int y) {
    take_candidates(job.visibility, job.spheres.drawn().around, x, y, block_, block_who_, block_size_);
    block_x_[block_size_] = x;
    block_y_[block_size_] = y;
    if (++block_size_ == kPointBlock) settle_edges(job);
}

void BandPainter::settle_edges(const PaintJob& job) {
    if (block_size_ == 0) return;
    clear_candidates(block_, block_size_);
    settle_candidates(job.sight, job.cut, job.spheres.drawn().shapes, block_who_, block_);
    for (int i = 0; i < block_size_; ++i) {
        bool any = false;
        for (int c = 0; c < block_.candidates; ++c) {
            if (block_.candidate[c][i].radius < 0 || block_.share[c][i] <= 0) continue;
            if (!paints(job, block_who_[c][i] + 1)) continue;
            any = true;
            parts_.push_back({block_who_[c][i], static_cast<std::uint32_t>(soft_.size()),
                              block_.x[i] + block_.mean_x[c][i], block_.y[i] + block_.mean_y[c][i],
                              block_.share[c][i]});
        }
        if (any) soft_.push_back({block_x_[i], block_y_[i]});
    }
    block_size_ = 0;
}

// Sorts entries by grain, and calls light(grain, begin, end) with each grain's part of `sorted`, so that
// points fill registers.
template <class Of, class Light>
void BandPainter::for_each_grain(const PaintJob& job, const std::vector<Of>& all, std::vector<Of>& sorted,
                                 const Light& light) {
    count_.resize(std::max(count_.size(), job.visibility.shown().size()), 0);
    met_.clear();
    for (const Of& one : all)
        if (count_[job.slot_of[one.grain]]++ == 0) met_.push_back(one.grain);
    std::uint32_t sum = 0;
    for (const std::uint32_t grain : met_) {
        const std::uint32_t count = count_[job.slot_of[grain]];
        count_[job.slot_of[grain]] = sum;
        sum += count;
    }
    sorted.resize(all.size());
    for (const Of& one : all) sorted[count_[job.slot_of[one.grain]]++] = one;
    std::size_t begin = 0;
    for (const std::uint32_t grain : met_) {
        const std::size_t end = count_[job.slot_of[grain]];
        count_[job.slot_of[grain]] = 0;
        light(grain, begin, end);
        begin = end;
    }
}

void BandPainter::light_runs(const PaintJob& job, Layer& layer) {
    const ToneTable& tone = ToneTable::get();
    for_each_grain(job, runs_, sorted_runs_, [&](std::uint32_t grain, std::size_t begin, std::size_t end) {
        std::size_t points = 0;
        for (std::size_t r = begin; r < end; ++r) {
            const Run& run = sorted_runs_[r];
            make_room(points + static_cast<std::size_t>(run.count));
            for (int i = 0; i < run.count; ++i, ++points) {
                x_[points] = static_cast<float>(run.x + i) + 0.5f;
                y_[points] = static_cast<float>(run.y) + 0.5f;
            }
        }
        pad(points);
        light(job, grain,
              {x_.data(), y_.data(), red_.data(), green_.data(), blue_.data(), static_cast<int>(points)});
        points = 0;
        for (std::size_t r = begin; r < end; ++r) {
            const Run& run = sorted_runs_[r];
            tone.pixels(&red_[points], &green_[points], &blue_[points], run.count, layer.row(run.y) + run.x);
            points += static_cast<std::size_t>(run.count);
        }
    });
}

void BandPainter::light_parts(const PaintJob& job) {
    for_each_grain(job, parts_, sorted_, [&](std::uint32_t grain, std::size_t begin, std::size_t end) {
        make_room(end - begin);
        for (std::size_t i = begin; i < end; ++i) x_[i - begin] = sorted_[i].x, y_[i - begin] = sorted_[i].y;
        pad(end - begin);
        light(
            job, grain,
            {x_.data(), y_.data(), red_.data(), green_.data(), blue_.data(), static_cast<int>(end - begin)});
        add_parts(begin, end);
    });
}

void BandPainter::add_parts(std::size_t begin, std::size_t end) {
    // Without a limit highlights would fray the edge.
    const auto clipped = [](float linear) { return std::min(linear, 1.0f); };
    for (std::size_t i = begin; i < end; ++i) {
        const Part& part = sorted_[i];
        Soft& pixel = soft_[part.pixel];
        pixel.red += part.share * clipped(red_[i - begin]);
        pixel.green += part.share * clipped(green_[i - begin]);
        pixel.blue += part.share * clipped(blue_[i - begin]);
        pixel.share += part.share;
    }
}

void BandPainter::light(const PaintJob& job, std::uint32_t grain, const LitPoints& points) {
    const std::size_t slot = job.slot_of[grain];
    LitGrain lit;
    lit.sphere = job.spheres.drawn().around[grain];
    if (!job.spheres.shapes.empty()) lit.shape = &job.spheres.shapes[grain];
    for (std::size_t c = 0; c < 3; ++c) {
        lit.albedo[c] = job.spheres.albedo[grain][c];
        if (!job.spheres.poles.empty()) lit.pole[c] = job.spheres.poles[grain][c];
    }
    if (job.lamp.shadows) lit.casters = job.neighbourhood.casters(slot);
    if (!job.lamp.occlusion) return sphere_kernels().light(job.sight, job.cut, job.lamp, lit, points);
    const NeighbourSpan all = job.neighbourhood.occluders(slot);
    if (all.count <= kManyNeighbours) {
        lit.occluders = all;
        return sphere_kernels().light(job.sight, job.cut, job.lamp, lit, points);
    }
    for (int first = 0; first < points.count; first += kPointBlock) {
        const LitPoints some{points.x + first,    points.y + first,
                             points.red + first,  points.green + first,
                             points.blue + first, std::min(kPointBlock, points.count - first)};
        lit.occluders = nearest(job, lit.sphere, all, some);
        sphere_kernels().light(job.sight, job.cut, job.lamp, lit, some);
    }
}

// Finds, among a large grain's many neighbours, the neighbours that take light from these few points.
NeighbourSpan BandPainter::nearest(const PaintJob& job, const ViewSphere& own, const NeighbourSpan& all,
                                   const LitPoints& points) {
    const auto slope = [&](float px, float py) {
        const float depth = job.sight.orthographic ? 1 : own.z;
        return Eigen::Vector2f(job.sight.slope_x(px) * depth - own.x, job.sight.slope_y(py) * depth - own.y);
    };
    Eigen::Vector2f low = slope(points.x[0], points.y[0]), high = low;
    for (int i = 1; i < points.count; ++i) {
        const Eigen::Vector2f at = slope(points.x[i], points.y[i]);
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    // Distances are measured across the line of sight; `room` is how far perspective shifts points within the
    // grain.
    const float room = job.sight.orthographic ? 0 : own.radius * own.radius / std::max(own.z, own.radius);
    const Eigen::Vector2f middle = 0.5f * (low + high);
    const float spread = 0.5f * (high - low).norm() + room;
    near_.clear();
    for (int i = 0; i < all.count; ++i) {
        const NearGrain& n = all.first[i];
        const float beside = (Eigen::Vector2f(n.x, n.y) - middle).norm();
        if (beside < spread + (1 + Neighbourhood::kReach) * n.radius && n.z < 0.5f * own.radius + n.radius)
            near_.push_back(n);
    }
    return {near_.data(), static_cast<int>(near_.size())};
}

void BandPainter::encode(Layer& layer) const {
    const ToneTable& tone = ToneTable::get();
    for (const Soft& pixel : soft_) {
        const float inverse = 1 / pixel.share;
        const auto alpha = static_cast<std::uint32_t>(std::lround(255 * std::min(pixel.share, 1.0f)));
        const std::uint32_t bytes[3] = {tone.byte(pixel.red * inverse), tone.byte(pixel.green * inverse),
                                        tone.byte(pixel.blue * inverse)};
        std::uint32_t out = alpha << 24;
        for (int c = 0; c < 3; ++c) out |= (bytes[c] * alpha + 127) / 255 << (8 * c);
        layer.row(pixel.y)[pixel.x] = out;
    }
}

void SphereLayer::find_visible(const Sight& sight, const Cut& cut, const Spheres& spheres, Team& team,
                               const SolidDepth& solid) {
    visibility_.update(sight, cut, spheres.drawn(), team, solid);
}

void SphereLayer::find_order(const Sight& sight, const Cut& cut, const Spheres& spheres,
                             const std::vector<WallFace>& faces, Team& team) {
    wall_order_.update(sight, cut, spheres.drawn(), faces, visibility_, team);
}

void SphereLayer::find_neighbours(const Cut& cut, const Lamp& lamp, const Spheres& spheres, Team& team) {
    neighbourhood_.update(spheres.spheres, cut, lamp, visibility_.shown(), team);
}

const Layer& SphereLayer::light(const Sight& sight, const Cut& cut, const Lamp& lamp, const Spheres& spheres,
                                Team& team) {
    constexpr int kRows = 16;
    slot_of_.resize(spheres.spheres.size());
    const std::vector<std::uint32_t>& shown = visibility_.shown();
    for (std::size_t slot = 0; slot < shown.size(); ++slot)
        slot_of_[shown[slot]] = static_cast<std::uint32_t>(slot);
    const PaintJob job{sight, cut, lamp, spheres, visibility_, neighbourhood_, slot_of_};
    painters_.resize(static_cast<std::size_t>(team.size()));
    std::atomic<int> next{0};
    team.run([&](int member) {
        const FlushDenormals flush;
        BandPainter& painter = painters_[member];
        for (int y; (y = kRows * next.fetch_add(1, std::memory_order_relaxed)) < layer_.height;)
            painter.paint(job, y, std::min(y + kRows, layer_.height), layer_);
    });
    for (const WallPixel& pixel : wall_order_.pixels())
        layer_.row(pixel.y)[pixel.x] = faded(layer_.row(pixel.y)[pixel.x], 1 - pixel.hidden);
    return layer_;
}

}  // namespace grainreel
