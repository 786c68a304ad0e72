#include "engine/files/foreign/mercury/restart_walls.hpp"

#include <cmath>
#include <vector>

#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

RestartLine::RestartLine(std::string_view line) {
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        if (first_word_.empty()) first_word_ = word;
        const std::optional<double> number = number_of(word);
        if (!number) {
            entries_.emplace_back(lower_case(word), std::vector<double>());
        } else if (!entries_.empty()) {
            entries_.back().second.push_back(*number);
        }
    }
}

const std::vector<double>* RestartLine::find(std::string_view key, std::size_t count) const {
    const std::string wanted = lower_case(key);
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
        if (entry->first == wanted && entry->second.size() == count) return &entry->second;
    return nullptr;
}

std::optional<double> RestartLine::number(std::string_view key) const {
    const std::vector<double>* found = find(key, 1);
    return found ? std::optional(found->front()) : std::nullopt;
}

std::optional<Vec3> RestartLine::vector(std::string_view key) const {
    const std::vector<double>* found = find(key, 3);
    if (!found) return std::nullopt;
    return Vec3((*found)[0], (*found)[1], (*found)[2]);
}

const std::vector<double>& RestartLine::first_numbers() const {
    static const std::vector<double> none;
    for (const auto& [key, numbers] : entries_)
        if (!numbers.empty()) return numbers;
    return none;
}

namespace {

using Polygon = std::vector<Vec3>;

// The part of a polygon where x·way <= most (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const Vec3& way, double most) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double from = way.dot(a) - most, to = way.dot(b) - most;
        if (from <= 0) kept.push_back(a);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) kept.push_back(a + (b - a) * (from / (from - to)));
    }
    return kept;
}

// A polygon on a face of the box may lie outside it by rounding.
Polygon cut_to(Polygon polygon, const Vec3& low, const Vec3& high) {
    const double slack = 1e-9 * (high - low).norm();
    for (int axis = 0; axis < 3; ++axis) {
        polygon = cut(polygon, Vec3::Unit(axis), high[axis] + slack);
        polygon = cut(polygon, -Vec3::Unit(axis), -low[axis] + slack);
    }
    for (Vec3& corner : polygon) corner = corner.cwiseMax(low).cwiseMin(high);
    return polygon;
}

}  // namespace

TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box) {
    TriangleMesh mesh;
    const Vec3 low = box.origin, high = box.origin + box.edges[0] + box.edges[1] + box.edges[2];
    const double size = (high - low).norm();
    if (!(outwards.norm() > 0) || !(size > 0) || !place.allFinite()) return mesh;
    const Vec3 normal = outwards.normalized();
    const Vec3 middle = 0.5 * (low + high);
    const Vec3 foot = middle + normal * normal.dot(place - middle);
    int axis = 0;
    normal.cwiseAbs().minCoeff(&axis);
    const Vec3 u = normal.cross(Vec3::Unit(axis)).normalized(), v = u.cross(normal);
    const Polygon large{foot - size * u - size * v, foot + size * u - size * v, foot + size * u + size * v,
                        foot - size * u + size * v};
    Polygon polygon = cut_to(large, low, high);
    if (polygon.size() < 3) {  // the plane is outside the box: it is cut at the box's end and moved back
        const double reach = 0.5 * normal.cwiseAbs().dot(high - low);
        const double away = normal.dot(foot - middle);
        const Vec3 shift = normal * (std::copysign(reach * (1 - 1e-9), away) - away);
        polygon.clear();
        for (const Vec3& corner : large) polygon.push_back(corner + shift);
        polygon = cut_to(polygon, low, high);
        for (Vec3& corner : polygon) corner -= shift;
    }
    if (polygon.size() < 3) return mesh;
    mesh.vertices = polygon;
    for (std::size_t i = 2; i < polygon.size(); ++i)  // their corners go round against the normal
        mesh.triangles.push_back({0, static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i)});
    return mesh;
}

}  // namespace grainreel
