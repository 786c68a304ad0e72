// Draws the depth and number of spheres in bands of rows, nearest spheres first. Hot code.
#include "render/picture/spheres/visibility.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

// Where a sphere's silhouette begins and ends along one axis of the picture, as s = x/z. These are the
// tangents from the eye, (c - s z)^2 = r^2 (1 + s^2) (after Mara & McGuire 2013). z must be larger than r.
struct Span {
    double low, high;
};
Span tangents(double c, double z, double r) {
    const double root = r * std::sqrt(std::max(0.0, c * c + z * z - r * r)), below = z * z - r * r;
    return {(c * z - root) / below, (c * z + root) / below};
}

}  // namespace

Visibility::Visibility(int width, int height)
    : width_(width),
      height_(height),
      stride_((static_cast<std::size_t>(width) + 15) / 16 * 16 + 2 * kPad),
      seen_(stride_ * height, 0),
      slope_x_(stride_),
      band_(static_cast<std::size_t>(bands())) {}

PixelBox Visibility::bounds(const Sight& sight, const ViewSphere& sphere) const {
    const double x = sphere.x, y = sphere.y, z = sphere.z, r = sphere.radius;
    if (!sight.orthographic && z <= -r) return {};
    if (!sight.orthographic && z <= r * 1.0001)
        return {0, 0, width_, height_};  // the sphere crosses the eye's plane
    const Span across = sight.orthographic ? Span{x - r, x + r} : tangents(x, z, r);
    const Span upward = sight.orthographic ? Span{y - r, y + r} : tangents(y, z, r);
    const auto pixel = [&](double centre, double slope, int size) {
        return static_cast<int>(std::clamp(centre + sight.focal * slope, 0.0, static_cast<double>(size)));
    };
    return {pixel(sight.centre_x, across.low, width_), pixel(sight.centre_y, -upward.high, height_),
            std::min(width_, pixel(sight.centre_x, across.high, width_) + 1),
            std::min(height_, pixel(sight.centre_y, -upward.low, height_) + 1)};
}

void Visibility::place(const Sight& sight, const Cut& cut, const std::vector<ViewSphere>& spheres,
                       Team& team) {
    box_.resize(spheres.size());
    team.run([&](int member) {
        const std::size_t share = spheres.size() / team.size() + 1, begin = member * share;
        for (std::size_t i = begin; i < std::min(begin + share, spheres.size()); ++i)
            box_[i] = cut.planes && cut.share(spheres[i]) <= 0 ? PixelBox{} : bounds(sight, spheres[i]);
    });
}

// Sorts grains coarsely by their nearest points. The order only serves speed: grains drawn first hide grains
// that come later.
void Visibility::sort_nearest_first(const std::vector<ViewSphere>& spheres) {
    constexpr std::size_t kSlices = 4096;
    float low = kNothing, high = -kNothing;
    const auto nearest = [&](std::size_t i) { return spheres[i].z - spheres[i].radius; };
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (box_[i].empty()) continue;
        low = std::min(low, nearest(i));
        high = std::max(high, nearest(i));
    }
    const float scale = high > low ? (kSlices - 1) / (high - low) : 0;
    const auto slice = [&](std::size_t i) { return static_cast<std::size_t>((nearest(i) - low) * scale); };
    std::vector<std::uint32_t> start(kSlices + 1, 0);
    for (std::size_t i = 0; i < spheres.size(); ++i)
        if (!box_[i].empty()) ++start[slice(i) + 1];
    for (std::size_t s = 0; s < kSlices; ++s) start[s + 1] += start[s];
    order_.resize(start[kSlices]);
    for (std::size_t i = 0; i < spheres.size(); ++i)
        if (!box_[i].empty()) order_[start[slice(i)]++] = static_cast<std::uint32_t>(i);
}

void Visibility::fill_bands() {
    for (auto& band : band_) band.clear();
    for (const std::uint32_t i : order_)
        for (int band = box_[i].y0 / kBand; band * kBand < box_[i].y1; ++band) band_[band].push_back(i);
}

// Whether all tiles that the box touches are filled with nearer spheres. The farthest depth of a tile is
// found anew only now and then. An old depth does no harm: grains are then drawn that need not be drawn.
bool Visibility::hidden(Worker& worker, int band, const PixelBox& box, float nearest, const DepthRows& rows) {
    constexpr int kStale = 6;  // grains
    for (int tile = box.x0 / kTile; tile * kTile < box.x1; ++tile) {
        if (worker.drawn[tile] >= kStale) {
            worker.drawn[tile] = 0;
            worker.far[tile] = sphere_kernels().farthest(
                rows, {tile * kTile, band * kBand, std::min(width_, (tile + 1) * kTile),
                       std::min(height_, (band + 1) * kBand)});
        }
        if (nearest <= worker.far[tile]) return false;
    }
    return true;
}

// Returns the place of the depth of the band's first pixel. Without anything solid, depths are kept only
// while the band is drawn.
float* Visibility::depth_of_band(int band, Worker& worker, const SolidDepth& solid) {
    if (!solid.away) {
        worker.depth.assign(kBand * stride_, kNothing);
        return worker.depth.data() + kPad;
    }
    const int y0 = band * kBand;
    float* first = depth_.data() + static_cast<std::size_t>(y0) * stride_ + kPad;
    for (int y = y0; y < std::min(height_, y0 + kBand); ++y)
        std::copy_n(solid.away + static_cast<std::size_t>(y) * solid.stride, width_,
                    first + static_cast<std::size_t>(y - y0) * stride_);
    return first;
}

void Visibility::draw_band(int band, Worker& worker, const Sight& sight, const Cut& cut,
                           const DrawnGrains& grains, const SolidDepth& solid) {
    const std::vector<ViewSphere>& spheres = grains.around;
    const int y0 = band * kBand, y1 = std::min(height_, y0 + kBand);
    const std::size_t first = static_cast<std::size_t>(y0) * stride_ + kPad;
    std::fill_n(seen_.begin() + static_cast<std::ptrdiff_t>(first - kPad), (y1 - y0) * stride_, 0u);
    if (band_[band].empty() && !solid.away) return;
    float* depth = depth_of_band(band, worker, solid);
    const std::size_t tiles = static_cast<std::size_t>(width_) / kTile + 1;
    worker.far.assign(tiles, kNothing);
    worker.drawn.assign(tiles, 0);
    const DepthRows rows{slope_x_.data() + kPad, depth, seen_.data() + first, stride_, y0};
    for (const std::uint32_t i : band_[band]) {
        PixelBox box = box_[i];
        box.y0 = std::max(box.y0, y0);
        box.y1 = std::min(box.y1, y1);
        if (hidden(worker, band, box, spheres[i].z - spheres[i].radius, rows)) continue;
        if (grains.shapes)
            sphere_kernels().draw_shape(sight, cut, rows, spheres[i], grains.shapes[i], box, i + 1);
        else
            sphere_kernels().draw(sight, cut, rows, spheres[i], box, i + 1);
        for (int tile = box.x0 / kTile; tile * kTile < box.x1; ++tile) ++worker.drawn[tile];
    }
    note_shown(band, worker);
}

// Notes which grains are seen in the band. It also copies the pixels at the ends of each row to those beside
// it, so that no edge is seen there.
void Visibility::note_shown(int band, Worker& worker) {
    for (int y = band * kBand; y < std::min(height_, (band + 1) * kBand); ++y) {
        std::uint32_t* own = seen_.data() + static_cast<std::size_t>(y) * stride_ + kPad;
        std::fill_n(own + width_, kPad, own[width_ - 1]);
        own[-1] = 0;
        sphere_kernels().mark_changes(own, width_, worker.changes.room(width_));
        own[-1] = own[0];
        for (int x = worker.changes.next(0); x < width_; x = worker.changes.next(x + 1)) {
            if (own[x] == 0 || worker.seen_in[own[x] - 1] == static_cast<std::uint32_t>(band) + 1) continue;
            worker.seen_in[own[x] - 1] = static_cast<std::uint32_t>(band) + 1;
            worker.shown.push_back(own[x] - 1);
        }
    }
}

void Visibility::collect_shown(std::size_t count) {
    std::vector<bool> marked(count, false);
    for (const Worker& worker : workers_)
        for (const std::uint32_t i : worker.shown) marked[i] = true;
    shown_.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (marked[i]) shown_.push_back(static_cast<std::uint32_t>(i));
}

void Visibility::update(const Sight& sight, const Cut& cut, const DrawnGrains& grains, Team& team,
                        const SolidDepth& solid) {
    const std::vector<ViewSphere>& spheres = grains.around;
    if (solid.away) depth_.resize(seen_.size(), kNothing);
    for (std::size_t x = 0; x < stride_; ++x)
        slope_x_[x] = sight.slope_x(static_cast<float>(static_cast<int>(x) - kPad) + 0.5f);
    place(sight, cut, spheres, team);
    sort_nearest_first(spheres);
    fill_bands();
    workers_.resize(static_cast<std::size_t>(team.size()));
    std::atomic<int> next{0};
    team.run([&](int member) {
        Worker& worker = workers_[member];
        worker.seen_in.assign(spheres.size(), 0);
        worker.shown.clear();
        for (int band; (band = next.fetch_add(1, std::memory_order_relaxed)) < bands();)
            draw_band(band, worker, sight, cut, grains, solid);
    });
    collect_shown(spheres.size());
}

double Visibility::seen_share(std::size_t grain) const {
    const PixelBox& box = box_[grain];
    if (box.empty()) return 0;
    std::ptrdiff_t seen = 0;
    for (int y = box.y0; y < box.y1; ++y)
        seen += std::count(row(y) + box.x0, row(y) + box.x1, static_cast<std::uint32_t>(grain) + 1);
    const double outline = 0.25 * std::numbers::pi * (box.x1 - box.x0) * (box.y1 - box.y0);
    return std::min(1.0, static_cast<double>(seen) / outline);
}

namespace {

constexpr ViewSphere kNobody{0, 0, 1, -1};

}  // namespace

void take_candidates(const Visibility& visibility, const std::vector<ViewSphere>& spheres, int x, int y,
                     EdgeBlock& block, std::uint32_t (&who)[kCandidates][kPointBlock], int at) {
    const std::uint32_t* row = visibility.row(y);
    const std::uint32_t around[5] = {row[x], row[x - 1], row[x + 1], visibility.row(std::max(0, y - 1))[x],
                                     visibility.row(std::min(y + 1, visibility.height() - 1))[x]};
    int found = 0;
    for (const std::uint32_t number : around) {
        bool is_new = number != 0 && found < kCandidates;
        for (int c = 0; c < found && is_new; ++c) is_new = who[c][at] != number - 1;
        if (!is_new) continue;
        who[found][at] = number - 1;
        block.candidate[found++][at] = spheres[number - 1];
    }
    for (int c = found; c < kCandidates; ++c) block.candidate[c][at] = kNobody;
    block.candidates = at == 0 ? found : std::max(block.candidates, found);
    block.x[at] = static_cast<float>(x) + 0.5f;
    block.y[at] = static_cast<float>(y) + 0.5f;
}

void clear_candidates(EdgeBlock& block, int begin) {
    for (int i = begin; i < kPointBlock; ++i) {
        block.x[i] = block.y[i] = 0;
        for (auto& candidate : block.candidate) candidate[i] = kNobody;
    }
}

void settle_candidates(const Sight& sight, const Cut& cut, const ViewShape* shapes,
                       const std::uint32_t (&who)[kCandidates][kPointBlock], EdgeBlock& block) {
    if (!shapes) return sphere_kernels().settle(sight, cut, block);
    for (int c = 0; c < block.candidates; ++c)
        for (int i = 0; i < kPointBlock; ++i)
            block.shape[c][i] = block.candidate[c][i].radius > 0 ? shapes + who[c][i] : nullptr;
    sphere_kernels().settle_shapes(sight, cut, block);
}

}  // namespace grainreel
