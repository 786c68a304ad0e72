// Lights walls in tiles of 16 x 16 pixels: which grains are near or between the tile and the lamp. Hot code.
#include "render/picture/spheres/light/wall_light.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace grainreel {

WallLight::WallLight(int width, int height)
    : width_(width),
      height_(height),
      shares_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255),
      spans_(static_cast<std::size_t>(height)) {}

namespace {

// In which rows of a tile any number is not 0, as bits. stride: numbers from row to row.
template <class Number>
std::uint32_t rows_with_any(const Number* numbers, std::size_t stride, int rows, int count) {
    std::uint32_t shown = 0;
    for (int r = 0; r < rows; ++r, numbers += stride) {
        Number any = 0;
        for (int i = 0; i < count; ++i) any |= numbers[i];
        shown |= std::uint32_t{any != 0} << r;
    }
    return shown;
}

}  // namespace

// Writes which faces the pixels of a band of tiles show, and in which rows of each tile there are any.
void WallLight::number_band(int y0) {
    const int rows = std::min(kTile, height_ - y0);
    const auto stride = static_cast<std::size_t>(width_);
    for (int y = y0; y < y0 + rows; ++y) number_row(y);
    for (Numbers& of : numbers_)
        for (int x = 0; x < width_; x += kTile)
            of.shown[tile_of(x, y0)] = static_cast<std::uint16_t>(
                rows_with_any(of.face.data() + static_cast<std::size_t>(y0) * stride + x, stride, rows,
                              std::min(kTile, width_ - x)));
}

// The rows of a tile in which grains do not hide each pixel and all its neighbours; bit r is row y + r.
std::uint32_t WallLight::bare_rows(const Visibility& seen, int x, int y, int rows, int count) const {
    std::uint32_t bare = 0;  // bit r: a pixel of row y + r - 1 shows no grain
    for (int r = 0; r < rows + 2; ++r) {
        const int row = y + r - 1;
        if (row < 0 || row >= height_) continue;
        const std::uint32_t* numbers = seen.row(row) + x - 1;
        std::uint32_t none = 0;  // all bits are set where a pixel shows no grain
        for (int i = 0; i < count + 2; ++i) none |= numbers[i] == 0 ? ~0u : 0u;
        bare |= (none & 1u) << r;
    }
    return (bare | bare >> 1 | bare >> 2) & ((1u << rows) - 1);
}

// A sphere around the points of a tile.
ViewSphere WallLight::around(const Sight& sight, Worker& worker, int rows) {
    worker.container_low = 1e9f, worker.container_high = -1e9f;
    Eigen::Array3f low(1e30f, 1e30f, 1e30f), high = -low;
    for (int r = 0; r < rows; ++r) {
        if ((worker.any >> r & 1) == 0) continue;
        const WallRow& row = worker.rows[r];
        int first = kWallRow, last = 0;
        float nearest = 1e30f, farthest = -1e30f;
        for (int i = 0; i < kWallRow; ++i) {
            const bool seen = row.taken[i] > 0;
            first = seen && i < first ? i : first, last = seen ? i : last;
            nearest = seen && row.away[i] < nearest ? row.away[i] : nearest;
            farthest = seen && row.away[i] > farthest ? row.away[i] : farthest;
            if (!seen) continue;
            worker.container_low = std::min(worker.container_low, row.container[i]);
            worker.container_high = std::max(worker.container_high, row.container[i]);
        }
        if (first > last) continue;
        for (const int i : {first, last})
            for (const float away : {nearest, farthest}) {
                const float scale = sight.orthographic ? 1 : away;
                const Eigen::Array3f at(sight.slope_x(row.x + static_cast<float>(i)) * scale,
                                        sight.slope_y(row.y) * scale, away);
                low = low.min(at), high = high.max(at);
            }
    }
    const Eigen::Array3f middle = 0.5f * (low + high);
    return {middle.x(), middle.y(), middle.z(), 0.5f * (high - low).matrix().norm()};
}

namespace {

NearGrain from_origin(const ViewSphere& origin, const ViewSphere& grain, float weight) {
    return {grain.x - origin.x,
            grain.y - origin.y,
            grain.z - origin.z,
            grain.radius,
            1 / grain.radius,
            grain.radius * grain.radius,
            weight};
}

float square(const NearGrain& n) {
    return n.x * n.x + n.y * n.y + n.z * n.z;
}

}  // namespace

// Whether a grain lies behind a wall of the container that the tile shows. Such a wall keeps its light.
bool WallLight::outside(const NearGrain& near, const Worker& worker) {
    if (worker.container_low != worker.container_high) return false;
    for (const CornerPlane& p : worker.corners)
        if (p.container == worker.container_low &&
            p.x * near.x + p.y * near.y + p.z * near.z - p.d < -near.radius)
            return true;
    return false;
}

void WallLight::find_occluders(const LightTakers& by, const ViewSphere& tile, Worker& worker) {
    worker.occluders.clear();
    if (!by.lamp.occlusion || by.grid.empty() || !by.grid.may_reach(tile)) return;
    ++worker.search;
    by.grid.around(tile, Neighbourhood::kWallReach, [&](std::uint32_t j) {
        if (std::exchange(worker.met_by[j], worker.search) == worker.search) return;
        const ViewSphere& grain = by.spheres[j];
        const NearGrain near = from_origin(tile, grain, by.cut.share(grain));
        const float reach = tile.radius + (1 + Neighbourhood::kWallReach) * grain.radius;
        if (near.weight > 0 && square(near) < reach * reach && !outside(near, worker))
            worker.occluders.push_back(near);
    });
}

// Finds the grains between a tile and the lamp. When they cover the tile many times over, it is black, and
// the search ends.
void WallLight::find_casters(const LightTakers& by, const ViewSphere& tile, Worker& worker) {
    constexpr float kBlack = 16;
    worker.casters.clear();
    if (!by.lamp.shadows || by.grid.empty()) return;
    ++worker.search;
    const float foot = by.grid.height(tile) - tile.radius, all = tile.radius * tile.radius;
    float covered = 0;
    const auto visit = [&](std::uint32_t j) {
        if (std::exchange(worker.met_by[j], worker.search) == worker.search) return;
        const ViewSphere& grain = by.spheres[j];
        const float ahead = by.grid.height(grain) - foot, weight = by.cut.share(grain);
        if (ahead <= 0 || weight <= 0) return;
        const NearGrain near = from_origin(tile, grain, weight);
        const float along = ahead - tile.radius;
        const float touch = tile.radius + 1.02f * grain.radius + by.lamp.spread * ahead;
        if (square(near) - along * along > touch * touch) return;
        if (outside(near, worker)) return;
        worker.casters.push_back(near);
        covered += std::min(near.square, all);
    };
    by.grid.towards_lamp(tile, by.lamp.spread, visit, [&] { return covered > kBlack * all; });
}

void WallLight::light_tile(const Job& job, int x, int y0, int rows, bool first, Worker& worker) {
    const ViewSphere tile = around(job.by.sight, worker, rows);
    if (worker.container_low > worker.container_high) return;
    worker.corners = corners_;
    for (CornerPlane& p : worker.corners) p.d -= p.x * tile.x + p.y * tile.y + p.z * tile.z;
    find_occluders(job.by, tile, worker);
    find_casters(job.by, tile, worker);
    const WallShade shade{{tile.x, tile.y, tile.z},
                          {worker.occluders.data(), static_cast<int>(worker.occluders.size())},
                          {worker.casters.data(), static_cast<int>(worker.casters.size())},
                          worker.corners.data(),
                          static_cast<int>(worker.corners.size()),
                          job.corner_reach};
    const int count = std::min(kTile, width_ - x);
    for (int r = 0; r < rows; ++r) {
        WallRow& row = worker.rows[r];
        if ((worker.any >> r & 1) == 0) continue;
        sphere_kernels().light_wall(job.by.sight, job.by.lamp, shade, row);
        std::uint8_t* shares =
            shares_.data() + static_cast<std::size_t>(y0 + r) * static_cast<std::size_t>(width_) + x;
        for (int i = 0; i < count; ++i)
            shares[i] = static_cast<std::uint8_t>((first ? 255.0f : shares[i]) * row.share[i] + 0.5f);
        Layer::Span& span = spans_[y0 + r];
        span = span.begin < span.end ? Layer::Span{std::min(span.begin, x), std::max(span.end, x + count)}
                                     : Layer::Span{x, x + count};
    }
}

// shows(layer, x, y, rows, count): in which rows of a tile pixels show any wall, as bits. fill(layer, x, y,
// row): what the pixels of a row show.
template <class Shows, class Fill>
void WallLight::light(const Job& job, int layers, Team& team, const Shows& shows, const Fill& fill) {
    workers_.resize(static_cast<std::size_t>(team.size()));
    const int bands = (height_ + kTile - 1) / kTile;
    std::atomic<int> next{0};
    team.run([&](int member) {
        Worker& worker = workers_[member];
        worker.met_by.resize(job.by.spheres.size(), 0);
        for (int band; (band = next.fetch_add(1, std::memory_order_relaxed)) < bands;) {
            const int y0 = band * kTile, rows = std::min(kTile, height_ - y0);
            for (int y = y0; y < y0 + rows; ++y) {
                Layer::Span& span = spans_[y];
                std::fill(shares_.begin() + y * static_cast<std::ptrdiff_t>(width_) + span.begin,
                          shares_.begin() + y * static_cast<std::ptrdiff_t>(width_) + span.end,
                          std::uint8_t{255});
                span = {};
            }
            for (int x = 0; x < width_; x += kTile) {
                const int count = std::min(kTile, width_ - x);
                std::array<std::uint32_t, 2> shown{};  // rows, as bits
                for (int layer = 0; layer < layers; ++layer) shown[layer] = shows(layer, x, y0, rows, count);
                if ((shown[0] | shown[1]) == 0) continue;
                const std::uint32_t bare = bare_rows(job.by.seen, x, y0, rows, count);
                for (int layer = 0; layer < layers; ++layer) {
                    worker.any = shown[layer] & bare;
                    if (worker.any == 0) continue;
                    for (int r = 0; r < rows; ++r) {
                        if ((worker.any >> r & 1) == 0) continue;
                        WallRow& row = worker.rows[r];
                        row.x = static_cast<float>(x) + 0.5f, row.y = static_cast<float>(y0 + r) + 0.5f;
                        fill(layer, x, y0 + r, row);
                    }
                    light_tile(job, x, y0, rows, layer == 0, worker);
                }
            }
        }
    });
}

void WallLight::light_faces(const LightTakers& by, const std::vector<WallFace>& faces, float corner_reach,
                            Team& team) {
    const Sight& s = by.sight;
    const bool same = faces == last_ && !numbers_[0].face.empty() &&
                      s.orthographic == last_sight_.orthographic && s.focal == last_sight_.focal;
    if (!same) {
        last_ = faces, last_sight_ = s;
        for (Numbers& of : numbers_) {
            of.face.resize(shares_.size()), of.bare.resize(shares_.size());
            of.shown.resize(static_cast<std::size_t>(tiles_across() * ((height_ + kTile - 1) / kTile)));
        }
        set_faces(s, by.lamp, faces);
    }
    std::atomic<int> next{0};
    if (!same)
        team.run([&](int) {
            for (int y; (y = kTile * next.fetch_add(1, std::memory_order_relaxed)) < height_;) number_band(y);
        });
    if (faces_.empty()) {
        if (!same) std::fill(shares_.begin(), shares_.end(), std::uint8_t{255});
        std::fill(spans_.begin(), spans_.end(), Layer::Span{});
        return;
    }
    light(
        {by, corner_reach}, 2, team,
        [&](int layer, int x, int y, int, int) {
            return std::uint32_t{numbers_[layer].shown[tile_of(x, y)]};
        },
        [&](int layer, int x, int y, WallRow& row) { fill_from_faces(numbers_[layer], s, x, y, row); });
}

void WallLight::light_meshes(const LightTakers& by, const MeshPixels& meshes, Team& team) {
    corners_.clear();
    const auto place = [&](int x, int y) {
        return static_cast<std::size_t>(y) * meshes.stride + static_cast<std::size_t>(x);
    };
    light(
        {by, 0}, 1, team,
        [&](int, int x, int y, int rows, int count) {
            return rows_with_any(meshes.number + place(x, y), meshes.stride, rows, count);
        },
        [&](int, int x, int y, WallRow& row) {
            const std::uint32_t* numbers = meshes.number + place(x, y);
            const float* away = meshes.away + place(x, y);
            const int count = std::min(kWallRow, width_ - x);
            for (int i = 0; i < kWallRow; ++i) {
                const std::uint32_t number = i < count ? numbers[i] : 0;
                row.taken[i] = number ? 1 : 0, row.away[i] = number ? away[i] : 1;
                row.tone[i] = 1, row.wall[i] = row.container[i] = 0;
                if (number == 0) continue;
                for (int c = 0; c < 3; ++c) row.normal[c][i] = meshes.planes[number - 1].normal[c];
            }
        });
}

void WallLight::darken(int y, std::uint32_t* pixels) const {
    const Layer::Span span = spans_[y];
    darken_row(pixels + span.begin, row(y) + span.begin, span.end - span.begin);
}

}  // namespace grainreel
