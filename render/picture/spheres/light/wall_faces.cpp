// Which wall each pixel shows: the outlines of the walls' faces become numbers of pixels, and the numbers of
// a row become what its lighting needs. Hot code.
#include <algorithm>
#include <cmath>

#include "render/picture/spheres/light/wall_light.hpp"

namespace grainreel {
namespace {

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

void WallLight::set_faces(const Sight& sight, const Lamp& lamp, const std::vector<WallFace>& faces) {
    faces_.clear();
    corners_.clear();
    for (const WallFace& face : faces) {
        if (face.before || (face.taken <= 0 && face.opacity <= 0)) continue;
        Face made{};
        made.outline = projected(sight, face.corners);
        if (made.outline.size() < 3 || faces_.size() >= 65534) continue;
        made.plane.normal = face.inward.cast<float>();
        made.plane.distance = static_cast<float>(face.inward.dot(face.corners[0]));
        made.taken = static_cast<float>(face.taken), made.opacity = static_cast<float>(face.opacity);
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
            corners_.push_back(
                {n.x(), n.y(), n.z(), made.plane.distance, made.wall, made.container, made.taken});
        }
        faces_.push_back(std::move(made));
    }
    std::stable_sort(corners_.begin(), corners_.end(), [](const CornerPlane& a, const CornerPlane& b) {
        return a.container != b.container ? a.container < b.container : a.wall < b.wall;
    });
}

// Writes which faces each pixel of a row shows. Faces are convex, and later ones hide earlier ones, as far as
// they are opaque: walls fade into each other while the camera moves.
void WallLight::number_row(int y) {
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    std::uint16_t *upper = numbers_[0].face.data() + begin, *under = numbers_[1].face.data() + begin;
    std::uint8_t *bare = numbers_[0].bare.data() + begin, *bare_under = numbers_[1].bare.data() + begin;
    std::fill_n(upper, width_, std::uint16_t{0});
    std::fill_n(under, width_, std::uint16_t{0});
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
        const auto left = static_cast<std::uint32_t>(std::lround(255 * (1 - face.opacity)));
        for (int x = low < high ? pixel(low) : width_; x < (low < high ? pixel(high) : 0); ++x) {
            bare[x] = static_cast<std::uint8_t>(bare[x] * left / 255);
            bare_under[x] = static_cast<std::uint8_t>(bare_under[x] * left / 255);
            if (bare_under[x] == 0) under[x] = 0;
            if (face.taken > 0) {
                under[x] = bare[x] == 0 ? std::uint16_t{0} : upper[x];
                bare_under[x] = bare[x];
                upper[x] = static_cast<std::uint16_t>(f + 1);
                bare[x] = 255;
            } else if (bare[x] == 0) {
                upper[x] = 0;
            }
        }
    }
}

void WallLight::fill_from_faces(const Numbers& of, const Sight& sight, int x, int y, WallRow& row) const {
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x;
    const std::uint16_t* numbers = of.face.data() + begin;
    const std::uint8_t* bare = of.bare.data() + begin;
    const int count = std::min(kWallRow, width_ - x);
    const float v = sight.slope_y(row.y);
    for (int i = 0; i < kWallRow;) {
        const int number = i < count ? numbers[i] : 0;
        int end = i + 1;
        while (end < kWallRow && (end < count ? numbers[end] : 0) == number) ++end;
        if (number == 0) {
            for (; i < end; ++i) row.taken[i] = 0, row.away[i] = 1;
            continue;
        }
        const Face& face = faces_[number - 1];
        const Eigen::Vector3f n = face.plane.normal;
        const float distance = face.plane.distance, taken = face.taken / 255, tone = face.tone;
        const float wall = face.wall, container = face.container;
        for (int k = i; k < end; ++k) {
            const float across = n.x() * sight.slope_x(row.x + static_cast<float>(k)) + n.y() * v;
            row.away[k] = sight.orthographic ? (distance - across) / n.z() : distance / (across + n.z());
            row.normal[0][k] = n.x(), row.normal[1][k] = n.y(), row.normal[2][k] = n.z();
            row.taken[k] = taken * bare[k];
            row.tone[k] = tone, row.wall[k] = wall, row.container[k] = container;
        }
        i = end;
    }
}

}  // namespace grainreel
