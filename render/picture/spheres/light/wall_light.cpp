// Lights walls in tiles of 16 x 16 pixels: which wall each pixel shows, and which grains are near or between
// the tile and the lamp. Hot code.
#include "render/picture/spheres/light/wall_light.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace grainreel {
namespace {

constexpr double kHides = 0.5;  // opacity from which on a face hides others

// What is left of the colour of a wall that is turned like this, beside a floor. Light differs more than
// that; walls are drawn in one colour and shall not seem to be of several.
float tone_of(const Lamp& lamp, const Eigen::Vector3f& normal) {
    constexpr float kShown = 0.35f;  // 0.5 would be all of it, by the root that the kernel takes
    const Eigen::Vector3f key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]);
    const Eigen::Vector3f up(lamp.up[0], lamp.up[1], lamp.up[2]);
    const auto light = [&](const Eigen::Vector3f& n) {
        return lamp.ground + (lamp.sky - lamp.ground) * 0.5f * (1 + n.dot(up)) +
               lamp.key * std::max(0.0f, n.dot(key));
    };
    return std::min(1.0f, std::pow(light(normal) / light(up), kShown));
}

// The outline of a face in pixels; empty where a corner lies behind the eye.
std::vector<Eigen::Vector2d> projected(const Sight& sight, const std::vector<Vec3>& corners) {
    std::vector<Eigen::Vector2d> outline;
    for (const Vec3& p : corners) {
        if (!sight.orthographic && p.z() <= 0) return {};
        const double scale = sight.orthographic ? sight.focal : sight.focal / p.z();
        outline.emplace_back(sight.centre_x + scale * p.x(), sight.centre_y - scale * p.y());
    }
    return outline;
}

}  // namespace

WallLight::WallLight(int width, int height)
    : width_(width),
      height_(height),
      shares_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255),
      spans_(static_cast<std::size_t>(height)) {}

void WallLight::set_faces(const Sight& sight, const Lamp& lamp, const std::vector<WallFace>& faces) {
    faces_.clear();
    corners_.clear();
    for (const WallFace& face : faces) {
        if (face.before || (face.taken <= 0 && face.opacity < kHides)) continue;
        Face made{};
        made.outline = projected(sight, face.corners);
        if (made.outline.size() < 3 || faces_.size() >= 65534) continue;
        made.plane.normal = face.inward.cast<float>();
        made.plane.distance = static_cast<float>(face.inward.dot(face.corners[0]));
        made.taken = static_cast<float>(face.taken);
        made.wall = static_cast<float>(face.wall), made.container = static_cast<float>(face.container);
        made.tone = lamp.shadows && face.taken > 0 ? tone_of(lamp, made.plane.normal) : 1;
        double low = 1e9, high = -1e9;
        for (const Eigen::Vector2d& p : made.outline)
            low = std::min(low, p.y()), high = std::max(high, p.y());
        const auto row = [&](double y) {
            return static_cast<int>(std::clamp(std::floor(y), 0.0, static_cast<double>(height_)));
        };
        made.y0 = row(low), made.y1 = row(high + 1);
        if (face.taken > 0) {
            const Eigen::Vector3f& n = made.plane.normal;
            corners_.push_back({n.x(), n.y(), n.z(), made.plane.distance, made.wall, made.container});
        }
        faces_.push_back(std::move(made));
    }
    std::stable_sort(corners_.begin(), corners_.end(), [](const CornerPlane& a, const CornerPlane& b) {
        return a.container != b.container ? a.container < b.container : a.wall < b.wall;
    });
}

// Writes which face each pixel of a row shows. Faces are convex, and later ones hide earlier ones.
void WallLight::number_row(int y) {
    std::uint16_t* numbers = number_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    std::fill_n(numbers, width_, std::uint16_t{0});
    const double middle = y + 0.5;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Face& face = faces_[f];
        if (y < face.y0 || y >= face.y1) continue;
        double low = 1e9, high = -1e9;
        for (std::size_t k = 0; k < face.outline.size(); ++k) {
            const Eigen::Vector2d &a = face.outline[k], &b = face.outline[(k + 1) % face.outline.size()];
            if ((a.y() <= middle) == (b.y() <= middle)) continue;
            const double x = a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
            low = std::min(low, x), high = std::max(high, x);
        }
        const auto pixel = [&](double x) {
            return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width_)));
        };
        if (low < high)
            std::fill(numbers + pixel(low), numbers + pixel(high),
                      face.taken > 0 ? static_cast<std::uint16_t>(f + 1) : std::uint16_t{0});
    }
}

bool WallLight::fill_from_faces(const Sight& sight, int x, int y, WallRow& row) const {
    const std::uint16_t* numbers =
        number_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x;
    const int count = std::min(kWallRow, width_ - x);
    bool any = false;
    for (int i = 0; i < kWallRow; ++i) {
        const int number = i < count ? numbers[i] : 0;
        row.taken[i] = 0, row.away[i] = 1;
        if (number == 0) continue;
        any = true;
        const Face& face = faces_[static_cast<std::size_t>(number - 1)];
        const Eigen::Vector3f& n = face.plane.normal;
        const float u = sight.slope_x(static_cast<float>(x + i) + 0.5f),
                    v = sight.slope_y(static_cast<float>(y) + 0.5f);
        const float across = n.x() * u + n.y() * v;
        row.away[i] = sight.orthographic ? (face.plane.distance - across) / n.z()
                                         : face.plane.distance / (across + n.z());
        for (int c = 0; c < 3; ++c) row.normal[c][i] = n[c];
        row.taken[i] = face.taken, row.tone[i] = face.tone;
        row.wall[i] = face.wall, row.container[i] = face.container;
    }
    return any;
}

// Whether grains hide the pixels and all their neighbours.
bool WallLight::hidden(const Visibility& seen, int x, int y, int count) const {
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height_ - 1); ++row) {
        const std::uint32_t* numbers = seen.row(row) + x;
        bool bare = false;
        for (int i = -1; i <= count; ++i) bare |= numbers[i] == 0;
        if (bare) return false;
    }
    return true;
}

// A sphere around the points of a tile.
ViewSphere WallLight::around(const Sight& sight, const Worker& worker, int rows) {
    Eigen::Array3f low(1e30f, 1e30f, 1e30f), high = -low;
    for (int r = 0; r < rows; ++r) {
        if (!worker.any[static_cast<std::size_t>(r)]) continue;
        const WallRow& row = worker.rows[static_cast<std::size_t>(r)];
        for (int i = 0; i < kWallRow; ++i) {
            if (row.taken[i] <= 0) continue;
            const float scale = sight.orthographic ? 1 : row.away[i];
            const Eigen::Array3f at(sight.slope_x(row.x + static_cast<float>(i)) * scale,
                                    sight.slope_y(row.y) * scale, row.away[i]);
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

void WallLight::find_occluders(const LightTakers& by, const ViewSphere& tile, Worker& worker) {
    worker.occluders.clear();
    if (!by.lamp.occlusion || by.grid.empty() || !by.grid.may_reach(tile)) return;
    ++worker.search;
    by.grid.around(tile, Neighbourhood::kWallReach, [&](std::uint32_t j) {
        if (std::exchange(worker.met_by[j], worker.search) == worker.search) return;
        const ViewSphere& grain = by.spheres[j];
        const NearGrain near = from_origin(tile, grain, by.cut.share(grain));
        const float reach = tile.radius + (1 + Neighbourhood::kWallReach) * grain.radius;
        if (near.weight > 0 && square(near) < reach * reach) worker.occluders.push_back(near);
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
        worker.casters.push_back(near);
        covered += std::min(near.square, all);
    };
    by.grid.towards_lamp(tile, by.lamp.spread, visit, [&] { return covered > kBlack * all; });
}

void WallLight::light_tile(const Job& job, int x, int y0, int rows, Worker& worker) {
    const ViewSphere tile = around(job.by.sight, worker, rows);
    find_occluders(job.by, tile, worker);
    find_casters(job.by, tile, worker);
    worker.corners = corners_;
    for (CornerPlane& p : worker.corners) p.d -= p.x * tile.x + p.y * tile.y + p.z * tile.z;
    const WallShade shade{{tile.x, tile.y, tile.z},
                          {worker.occluders.data(), static_cast<int>(worker.occluders.size())},
                          {worker.casters.data(), static_cast<int>(worker.casters.size())},
                          worker.corners.data(),
                          static_cast<int>(worker.corners.size()),
                          job.corner_reach};
    const int count = std::min(kTile, width_ - x);
    for (int r = 0; r < rows; ++r) {
        WallRow& row = worker.rows[static_cast<std::size_t>(r)];
        if (!worker.any[static_cast<std::size_t>(r)]) continue;
        sphere_kernels().light_wall(job.by.sight, job.by.lamp, shade, row);
        std::uint8_t* shares =
            shares_.data() + static_cast<std::size_t>(y0 + r) * static_cast<std::size_t>(width_) + x;
        for (int i = 0; i < count; ++i) shares[i] = static_cast<std::uint8_t>(255 * row.share[i] + 0.5f);
        Layer::Span& span = spans_[static_cast<std::size_t>(y0 + r)];
        span = span.begin < span.end ? Layer::Span{std::min(span.begin, x), std::max(span.end, x + count)}
                                     : Layer::Span{x, x + count};
    }
}

// fill(x, y, row): what a row of pixels shows; returns whether it shows any wall.
template <class Fill>
void WallLight::light(const Job& job, Team& team, const Fill& fill) {
    workers_.resize(static_cast<std::size_t>(team.size()));
    const int bands = (height_ + kTile - 1) / kTile;
    std::atomic<int> next{0};
    team.run([&](int member) {
        Worker& worker = workers_[static_cast<std::size_t>(member)];
        worker.met_by.resize(job.by.spheres.size(), 0);
        for (int band; (band = next.fetch_add(1, std::memory_order_relaxed)) < bands;) {
            const int y0 = band * kTile, rows = std::min(kTile, height_ - y0);
            for (int y = y0; y < y0 + rows; ++y) {
                Layer::Span& span = spans_[static_cast<std::size_t>(y)];
                std::fill(shares_.begin() + y * static_cast<std::ptrdiff_t>(width_) + span.begin,
                          shares_.begin() + y * static_cast<std::ptrdiff_t>(width_) + span.end,
                          std::uint8_t{255});
                span = {};
            }
            for (int x = 0; x < width_; x += kTile) {
                bool any = false;
                for (int r = 0; r < rows; ++r) {
                    WallRow& row = worker.rows[static_cast<std::size_t>(r)];
                    row.x = static_cast<float>(x) + 0.5f, row.y = static_cast<float>(y0 + r) + 0.5f;
                    const bool seen =
                        !hidden(job.by.seen, x, y0 + r, std::min(kTile, width_ - x)) && fill(x, y0 + r, row);
                    worker.any[static_cast<std::size_t>(r)] = seen;
                    any |= seen;
                }
                if (any) light_tile(job, x, y0, rows, worker);
            }
        }
    });
}

void WallLight::light_faces(const LightTakers& by, const std::vector<WallFace>& faces, float corner_reach,
                            Team& team) {
    const Sight& s = by.sight;
    const bool same = faces == last_ && !number_.empty() && s.orthographic == last_sight_.orthographic &&
                      s.focal == last_sight_.focal;
    if (!same) {
        last_ = faces, last_sight_ = s;
        number_.resize(shares_.size());
        set_faces(s, by.lamp, faces);
    }
    constexpr int kRows = 16;
    std::atomic<int> next{0};
    if (!same)
        team.run([&](int) {
            for (int y; (y = kRows * next.fetch_add(1, std::memory_order_relaxed)) < height_;)
                for (int row = y; row < std::min(y + kRows, height_); ++row) number_row(row);
        });
    light({by, corner_reach}, team,
          [&](int x, int y, WallRow& row) { return fill_from_faces(s, x, y, row); });
}

void WallLight::light_meshes(const LightTakers& by, const MeshPixels& meshes, Team& team) {
    corners_.clear();
    light({by, 0}, team, [&](int x, int y, WallRow& row) {
        const std::size_t first = static_cast<std::size_t>(y) * meshes.stride + static_cast<std::size_t>(x);
        const int count = std::min(kWallRow, width_ - x);
        bool any = false;
        for (int i = 0; i < kWallRow; ++i) {
            const std::uint32_t number = i < count ? meshes.number[first + static_cast<std::size_t>(i)] : 0;
            row.taken[i] = 0, row.away[i] = 1;
            if (number == 0) continue;
            any = true;
            const SurfacePlane& plane = meshes.planes[number - 1];
            row.away[i] = meshes.away[first + static_cast<std::size_t>(i)];
            for (int c = 0; c < 3; ++c) row.normal[c][i] = plane.normal[c];
            row.taken[i] = row.tone[i] = 1;
            row.wall[i] = row.container[i] = 0;
        }
        return any;
    });
}

void WallLight::darken(int y, std::uint32_t* pixels) const {
    const Layer::Span span = spans_[static_cast<std::size_t>(y)];
    darken_row(pixels + span.begin, row(y) + span.begin, span.end - span.begin);
}

}  // namespace grainreel
