#include "engine/step/lists/screen_watch.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/step/lists/candidates.hpp"

namespace grainreel {

namespace {

// A piece of a wall near a grain: a triangle or a face, in the frame of the scene.
struct Piece {
    std::int32_t wall;
    Vec3 way;     // m, from the grain's centre to the nearest point
    Vec3 normal;  // unit; zero for the curved wall of a cylinder, which stands before nothing
};

// Neither the way to a nearest point nor the point changes by more than a grain moves: the nearest point of a
// convex set is a firmly nonexpansive function. `moves` is in m.
bool may_become_one_place(const Piece& a, const Piece& b, double moves) {
    constexpr double kOnePlace = 0.184;  // a little above 2 sin(kSmoothAngle / 2)
    const double of_a = a.way.norm(), of_b = b.way.norm();
    if (!(of_a > moves && of_b > moves)) return true;
    const double turns = 2 * moves / (2 * of_a - moves) + 2 * moves / (2 * of_b - moves);
    return (a.way / of_a - b.way / of_b).norm() < kOnePlace + turns;
}

// Whether a piece may come to lie between the centre and the nearest point of another, or this point in the
// piece's plane.
bool may_stand_before(const Piece& piece, const Piece& other, double moves, double radius) {
    constexpr double kInPlane = 2e-3;  // a little above that of stands_for() (patches.cpp)
    if (piece.normal.isZero(0)) return false;
    const double centre = -piece.normal.dot(piece.way), point = centre + piece.normal.dot(other.way);
    const bool both_before = centre > moves && point > 2 * moves + kInPlane * radius;
    const bool both_behind = centre < -moves && point < -2 * moves - kInPlane * radius;
    return !both_before && !both_behind;
}

class Watcher {
  public:
    Watcher(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts)
        : rules_(rules), nearby_(nearby), contacts_(contacts), grains_(nearby.grains) {
        for (const MeshWall& mesh : nearby.meshes) poses_.push_back(mesh.body.at(nearby.pose));
    }
    void list() {
        list_grains();
        list_pairs();
    }

  private:
    // A grain and a mesh nearby.
    struct Side {
        std::int32_t group, place;  // of MeshLists::near; -1 for a grain of another thread
        std::int32_t mesh;
        std::int32_t first_plane = 0, planes = 0;  // the planes of its triangles, each once
    };
    // A plane in the frame of the scene. Its normal points to the side of the grain.
    struct Plane {
        Vec3 normal;
        double level;  // m, normal . point
        bool is_far;   // whether the grain stays on its side until the next refresh
    };
    static constexpr std::int32_t kNone = -1;

    std::int32_t faces() const { return static_cast<std::int32_t>(nearby_.faces.size()); }
    const MeshNear& near_of(const Side& side) const { return contacts_.meshes[side.group].near[side.place]; }

    void list_grains();
    void list_sides();
    void list_planes(std::int32_t grain, Side& side);
    void gather(std::int32_t grain, std::vector<WallNeighbour>::const_iterator& wall);
    bool may_screen() const;
    void list_pairs();
    bool has_side(std::int32_t grain) const { return first_side_[grain] != kNone; }
    bool may_stand_between(std::int32_t grain, const Vec3& to_other) const;
    bool may_cross_any(const Side& side, std::int32_t grain, const Vec3& other) const;
    bool may_cross(const Surface& surface, std::int32_t triangle, const Vec3& from, const Vec3& to) const;
    void look_at(std::int32_t group, std::int32_t first, std::int32_t second);

    const ContactRules& rules_;
    const Nearby& nearby_;
    ThreadContacts& contacts_;
    const Grains& grains_;
    std::vector<BodyPose> poses_;
    std::vector<Side> sides_;               // by rising grain, then mesh
    std::vector<std::int32_t> first_side_;  // for each grain: its first in sides_, or kNone
    std::vector<std::int32_t> of_side_;     // the grain of each
    std::vector<Plane> planes_;
    std::vector<Piece> pieces_;  // of one grain, and its radius (m)
    double radius_ = 0;
};

// Sides of own grains come from the lists of triangles. Grains of other threads have sides too, since a pair
// belongs to both threads, and both must find the same.
void Watcher::list_sides() {
    first_side_.assign(grains_.size(), kNone);
    std::vector<std::int32_t> next(contacts_.meshes.size(), 0);
    for (const auto& [grain, mesh] : nearby_.lists.meshes) {
        Side side{kNone, kNone, mesh};
        if (contacts_.owns(grain)) {
            const auto g = rules_.group_of(mesh, grains_.species[grain]);
            const std::vector<MeshNear>& near = contacts_.meshes[g].near;
            const std::int32_t at = next[g];
            if (at == std::ssize(near) || near[at].grain != grain || near[at].mesh != mesh) continue;
            side = {static_cast<std::int32_t>(g), next[g]++, mesh};
            list_planes(grain, side);
        }
        if (first_side_[grain] == kNone) first_side_[grain] = static_cast<std::int32_t>(sides_.size());
        sides_.push_back(side);
        of_side_.push_back(grain);
    }
}

void Watcher::list_planes(std::int32_t grain, Side& side) {
    constexpr double kEqual = 1e-9;
    constexpr std::ptrdiff_t kRecent = 16;  // planes among which equal ones are looked for
    const MeshNear& near = near_of(side);
    const Surface& surface = *nearby_.meshes[side.mesh].surface;
    const BodyPose& pose = poses_[side.mesh];
    const Place& own = grains_.place[grain];
    const auto* const triangle = contacts_.meshes[side.group].triangles.data() + near.first;
    side.first_plane = static_cast<std::int32_t>(planes_.size());
    for (std::int32_t t = 0; t < near.count; ++t) {
        const Vec3& out = surface.normal(triangle[t].number);
        const double distance = out.dot(near.centre - surface.corner(triangle[t].number, 0));
        const Vec3 normal = pose.rotation * (distance < 0 ? Vec3(-out) : out);
        const double level = normal.dot(own.position) - std::abs(distance);
        const auto recent = planes_.end() - std::min(kRecent, std::ssize(planes_) - side.first_plane);
        const bool is_old = std::any_of(recent, planes_.end(), [&](const Plane& p) {
            return (p.normal - normal).squaredNorm() < kEqual * kEqual &&
                   std::abs(p.level - level) < kEqual * own.radius;
        });
        if (!is_old) planes_.push_back({normal, level, std::abs(distance) > nearby_.skin});
    }
    side.planes = static_cast<std::int32_t>(planes_.size()) - side.first_plane;
}

// Gathers the pieces of all walls near an own grain, or none if there is one wall only. `wall` is the place
// in the list of near faces.
void Watcher::gather(std::int32_t grain, std::vector<WallNeighbour>::const_iterator& wall) {
    const Place& own = grains_.place[grain];
    pieces_.clear();
    radius_ = own.radius;
    while (wall != nearby_.lists.walls.end() && wall->grain < grain) ++wall;
    for (; wall != nearby_.lists.walls.end() && wall->grain == grain; ++wall) {
        const Face& face = nearby_.faces[wall->face];
        const FaceDistance to = distance_at(face, nearby_.pose, own.position);
        const bool flat = face.kind == Face::Kind::plane && !face.ends;
        if (to.distance < own.radius + nearby_.skin)
            pieces_.push_back({wall->face, -to.distance * to.normal, flat ? to.normal : Vec3(0, 0, 0)});
    }
    const auto first = static_cast<std::size_t>(first_side_[grain]);
    if (pieces_.empty() && (first + 1 == sides_.size() || of_side_[first + 1] != grain)) return;
    for (std::size_t s = first; s < sides_.size() && of_side_[s] == grain; ++s) {
        const Side& side = sides_[s];
        const MeshNear& near = near_of(side);
        const Surface& surface = *nearby_.meshes[side.mesh].surface;
        const auto* const triangle = contacts_.meshes[side.group].triangles.data() + near.first;
        for (std::int32_t t = 0; t < near.count; ++t) {
            const Vec3 way = surface.nearest(triangle[t].number, near.centre).at - near.centre;
            pieces_.push_back({faces() + side.mesh, poses_[side.mesh].rotation * way,
                               poses_[side.mesh].rotation * surface.normal(triangle[t].number)});
        }
    }
}

bool Watcher::may_screen() const {
    constexpr std::size_t kMany = 200;  // it costs less to watch such a grain than to compare its pieces
    if (pieces_.size() > kMany) return true;
    for (const Piece& one : pieces_)
        for (const Piece& other : pieces_) {
            if (one.wall == other.wall || std::max(one.wall, other.wall) < faces()) continue;
            if (may_become_one_place(one, other, nearby_.skin) ||
                may_stand_before(one, other, nearby_.skin, radius_))
                return true;
        }
    return false;
}

void Watcher::list_grains() {
    list_sides();
    ScreenWatch& watch = contacts_.screens;
    auto wall = nearby_.lists.walls.cbegin();
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        const std::int32_t grain = of_side_[s];
        if (!contacts_.owns(grain) || (s > 0 && of_side_[s - 1] == grain)) continue;
        gather(grain, wall);
        if (pieces_.empty() || !may_screen()) continue;
        const auto first = static_cast<std::int32_t>(watch.walls.size());
        for (const Piece& piece : pieces_)
            if (std::ssize(watch.walls) == first || watch.walls.back() != piece.wall)
                watch.walls.push_back(piece.wall);
        for (std::size_t k = s; k < sides_.size() && of_side_[k] == grain; ++k)
            contacts_.meshes[sides_[k].group].near[sides_[k].place].watched =
                static_cast<std::int32_t>(watch.grains.size());
        watch.grains.push_back({grain, first, static_cast<std::int32_t>(watch.walls.size()) - first});
    }
}

// Whether a triangle may come between two places (m, in its frame) that move.
bool Watcher::may_cross(const Surface& surface, std::int32_t triangle, const Vec3& from,
                        const Vec3& to) const {
    const Vec3 &normal = surface.normal(triangle), &corner = surface.corner(triangle, 0);
    const double one = normal.dot(from - corner), other = normal.dot(to - corner), moves = nearby_.skin;
    return !(one > moves && other > moves) && !(one < -moves && other < -moves);
}

bool Watcher::may_stand_between(std::int32_t grain, const Vec3& to_other) const {
    const Vec3 other = grains_.place[grain].position + to_other;
    for (auto s = static_cast<std::size_t>(first_side_[grain]); s < sides_.size() && of_side_[s] == grain;
         ++s) {
        const Side& side = sides_[s];
        if (side.place == kNone) {
            if (may_cross_any(side, grain, other)) return true;
            continue;
        }
        const Plane* const first = planes_.data() + side.first_plane;
        if (std::any_of(first, first + side.planes, [&](const Plane& plane) {
                return !plane.is_far || !(plane.normal.dot(other) - plane.level > nearby_.skin);
            }))
            return true;
    }
    return false;
}

// The same for a grain of another thread, whose triangles are not listed here.
bool Watcher::may_cross_any(const Side& side, std::int32_t grain, const Vec3& other) const {
    const Surface& surface = *nearby_.meshes[side.mesh].surface;
    const BodyPose& pose = poses_[side.mesh];
    const Place& own = grains_.place[grain];
    const Vec3 from = pose.at_rest(own.position), to = pose.at_rest(other);
    std::vector<std::int32_t> triangles;
    surface.near(from, own.radius + nearby_.skin, triangles);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](std::int32_t triangle) { return may_cross(surface, triangle, from, to); });
}

// A mesh that stands between two grains that touch is within the radius of one of them.
void Watcher::look_at(std::int32_t group, std::int32_t first, std::int32_t second) {
    const bool of_pairs = rules_.groups[group].of_pairs;
    if (!has_side(first) && !(of_pairs && has_side(second))) return;
    const Vec3 other =
        of_pairs ? grains_.place[second].position : nearby_.glued.centre(second, nearby_.faces, nearby_.pose);
    Vec3 apart = other - grains_.place[first].position;
    apart.x() = wrapped(apart.x(), rules_.period);
    if ((has_side(first) && may_stand_between(first, apart)) ||
        (of_pairs && has_side(second) && may_stand_between(second, -apart)))
        contacts_.screens.pairs.push_back({group, first, second});
}

void Watcher::list_pairs() {
    for (std::size_t g = 0; g < contacts_.tables.size(); ++g) {
        if (!rules_.groups[g].of_pairs && !rules_.groups[g].of_glued) continue;
        const ContactTable& table = contacts_.tables[g];
        const auto group = static_cast<std::int32_t>(g);
        table.each_stretch([&](std::int32_t from, std::int32_t to) {
            for (std::int32_t c = from; c < to; ++c) look_at(group, table.first()[c], table.second()[c]);
        });
        for (std::int32_t c = 0; c < table.candidates(); ++c)
            look_at(group, table.near_first()[c], table.near_second()[c]);
    }
    std::sort(contacts_.screens.pairs.begin(), contacts_.screens.pairs.end());
}

}  // namespace

void list_screens(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    contacts.screens.clear();
    if (!nearby.meshes.empty()) Watcher(rules, nearby, contacts).list();
}

}  // namespace grainreel
