// Finds the pixels in which grains reach through walls, and which shares walls and grains hide of each other
// there. Hot code.
#include "render/picture/spheres/wall_order.hpp"

#include <algorithm>

#include "render/picture/spheres/visibility.hpp"

namespace grainreel {
namespace {

// Pixels by which grains may reach into walls, as grains in contact do, without a visible error. Glass, which
// tints by a twentieth, allows more.
constexpr double kUnseen = 0.25, kUnseenThroughGlass = 0.5;

}  // namespace

bool WallOrder::Plate::disorders(const Vec3& centre, double radius) const {
    const double height = plane.height(centre);
    if (before ? height <= -radius : height >= radius) return false;
    for (const Plane& side : sides)
        if (side.height(centre) <= -radius) return false;
    return true;
}

// If the grain's centre is on the wrong side, this is the whole grain. Otherwise the part is a cap of less
// than half of the grain, and this is a sphere around the circle in which the plane cuts the grain.
ViewSphere WallOrder::Plate::wrong_part(const Vec3& centre, double radius) const {
    const double height = plane.height(centre), inside = before ? -height : height;
    const auto sphere = [](const Vec3& c, double r) {
        return ViewSphere{static_cast<float>(c.x()), static_cast<float>(c.y()), static_cast<float>(c.z()),
                          static_cast<float>(r)};
    };
    if (inside <= 0) return sphere(centre, radius);
    return sphere(centre - height * plane.normal,
                  std::sqrt(std::max(0.0, radius * radius - height * height)));
}

double WallOrder::Plate::meet(double x, double y, bool orthographic) const {
    const double across = plane.normal.x() * x + plane.normal.y() * y;
    const double z = orthographic ? (plane.distance - across) / plane.normal.z()
                                  : plane.distance / (across + plane.normal.z());
    const Vec3 at = orthographic ? Vec3(x, y, z) : Vec3(x * z, y * z, z);
    for (const Plane& border : borders)
        if (border.height(at) < 0) return -1;
    return z;
}

void WallOrder::prepare(const Sight& sight, const std::vector<WallFace>& faces) {
    plates_.clear();
    for (const WallFace& face : faces) {
        const std::vector<Vec3>& corners = face.corners;
        Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            middle += corners[k] / static_cast<double>(corners.size());
            area += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
        }
        const Vec3 away = sight.orthographic ? Vec3(0, 0, 1) : middle.normalized();
        const double size = std::sqrt(area.norm());
        // Nothing is seen of a face when the eye is in its plane.
        if (size <= 0 || face.opacity <= 0 || std::abs(area.dot(away)) < 1e-6 * size * size) continue;
        const Vec3 normal = (area.dot(away) > 0 ? Vec3(-area) : area).normalized();
        Plate plate{{normal, normal.dot(middle)}, {}, {}, face.opacity, face.before};
        const auto through_edge = [&](const Vec3& across, const Vec3& corner) {
            const Vec3 inward = across.dot(middle - corner) < 0 ? Vec3(-across) : across;
            return Plane{inward.normalized(), inward.normalized().dot(corner)};
        };
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Vec3& from = corners[k];
            const Vec3 along = corners[(k + 1) % corners.size()] - from;
            if (along.norm() < 1e-9 * size) continue;
            plate.borders.push_back(through_edge(along.cross(normal), from));
            plate.sides.push_back(through_edge(along.cross(sight.orthographic ? away : from), from));
        }
        plates_.push_back(std::move(plate));
    }
}

// Notes the pixels of the box that show the grain, or have a neighbour that does.
void WallOrder::note_grain(std::uint32_t grain, const PixelBox& box, const Visibility& visibility,
                           Finding& finding) const {
    const std::uint32_t number = grain + 1;
    const int width = visibility.width(), height = visibility.height();
    for (int y = std::max(0, box.y0 - 1); y < std::min(height, box.y1 + 1); ++y) {
        const std::uint32_t *row = visibility.row(y), *above = visibility.row(std::max(0, y - 1)),
                            *below = visibility.row(std::min(height - 1, y + 1));
        for (int x = std::max(0, box.x0 - 1); x < std::min(width, box.x1 + 1); ++x)
            if (row[x] == number || row[x - 1] == number || row[x + 1] == number || above[x] == number ||
                below[x] == number)
                finding.pixels.push_back(static_cast<std::size_t>(y) * width + x);
    }
}

void WallOrder::find_pixels(const Sight& sight, const std::vector<ViewSphere>& spheres,
                            const Visibility& visibility, Team& team) {
    findings_.resize(static_cast<std::size_t>(team.size()));
    const std::vector<std::uint32_t>& shown = visibility.shown();
    team.run([&](int member) {
        Finding& finding = findings_[member];
        finding.pixels.clear();
        finding.active.assign(plates_.size(), false);
        for (std::size_t k = member; k < shown.size(); k += static_cast<std::size_t>(team.size())) {
            const ViewSphere& s = spheres[shown[k]];
            const Vec3 centre(s.x, s.y, s.z);
            const double pixel = (sight.orthographic ? 1 : s.z) / sight.focal;
            for (std::size_t p = 0; p < plates_.size(); ++p) {
                const double unseen = plates_[p].before ? kUnseenThroughGlass : kUnseen;
                if (!plates_[p].disorders(centre, s.radius - unseen * pixel)) continue;
                finding.active[p] = true;
                const PixelBox part = visibility.bounds(sight, plates_[p].wrong_part(centre, s.radius));
                note_grain(shown[k], part, visibility, finding);
            }
        }
    });
    std::vector<std::size_t> all;
    for (const Finding& finding : findings_)
        all.insert(all.end(), finding.pixels.begin(), finding.pixels.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    pixels_.clear();
    for (const std::size_t at : all)
        pixels_.push_back(
            {static_cast<int>(at % visibility.width()), static_cast<int>(at / visibility.width()), 0, 0});
    std::vector<Plate> active;
    for (std::size_t p = 0; p < plates_.size(); ++p)
        if (std::any_of(findings_.begin(), findings_.end(), [&](const Finding& f) { return f.active[p]; }))
            active.push_back(std::move(plates_[p]));
    plates_ = std::move(active);
}

void WallOrder::judge_block(const Sight& sight, const EdgeBlock& block, WallPixel* pixels, int count) const {
    for (int i = 0; i < count; ++i) {
        double covered = 0, hidden = 0, bared = 0;
        for (int p = 0; p < kPoints; ++p) {
            const double x = sight.slope_x(block.x[i] + kPointX[p] / 16);
            const double y = sight.slope_y(block.y[i] + kPointY[p] / 16);
            const double grain = block.nearest[p][i];
            if (grain >= kNoGrain) continue;
            covered += 1;
            double passed = 1, glass = 0, behind = 0;
            for (const Plate& plate : plates_) {
                const double wall = plate.meet(x, y, sight.orthographic);
                if (wall < 0) continue;
                if (plate.before) {
                    glass += plate.opacity;
                    if (wall > grain) behind += plate.opacity;
                } else if (wall < grain) {
                    passed *= 1 - plate.opacity;
                }
            }
            hidden += 1 - passed;
            if (glass > 0) bared += behind / glass;
        }
        pixels[i].hidden = covered > 0 ? static_cast<float>(hidden / covered) : 0;
        pixels[i].bared = static_cast<float>(bared / kPoints);
    }
}

void WallOrder::update(const Sight& sight, const Cut& cut, const DrawnGrains& grains,
                       const std::vector<WallFace>& faces, const Visibility& visibility, Team& team) {
    prepare(sight, faces);
    find_pixels(sight, grains.around, visibility, team);
    team.run([&](int member) {
        EdgeBlock block;
        std::uint32_t who[kCandidates][kPointBlock];
        const std::size_t stride = static_cast<std::size_t>(team.size()) * kPointBlock;
        for (std::size_t first = member * std::size_t{kPointBlock}; first < pixels_.size(); first += stride) {
            const int count = static_cast<int>(std::min<std::size_t>(kPointBlock, pixels_.size() - first));
            block.candidates = 0;
            for (int i = 0; i < count; ++i)
                take_candidates(visibility, grains.around, pixels_[first + i].x, pixels_[first + i].y, block,
                                who, i);
            clear_candidates(block, count);
            settle_candidates(sight, cut, grains.shapes, who, block);
            judge_block(sight, block, &pixels_[first], count);
        }
    });
    std::erase_if(pixels_, [](const WallPixel& pixel) { return pixel.hidden <= 0 && pixel.bared <= 0; });
}

}  // namespace grainreel
