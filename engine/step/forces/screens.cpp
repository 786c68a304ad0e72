#include "engine/step/forces/screens.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/step/forces/law_input.hpp"
#include "engine/step/lists/thread_contacts.hpp"

namespace grainreel {

namespace {

constexpr double kEqual = 1e-9;  // as a share of the radius
constexpr double kBefore = 1 - kEqual;
constexpr double kSameNormal = 0.86602540378443865;  // cos 30 degrees, as in PatchMatcher

std::int32_t faces_of(const ForceInput& in) {
    return static_cast<std::int32_t>(in.walls.faces.size());
}

// Whether a mesh crosses the way (m) from a place.
bool crosses(const ForceInput& in, std::size_t mesh, const Vec3& from, const Vec3& direction, double reach) {
    const WallPose& pose = in.walls.pose_of_mesh(static_cast<std::int32_t>(mesh));
    const Vec3 begin = pose.at_rest(from), end = pose.at_rest(from + direction);
    return in.meshes[mesh].surface->meets(begin, (end - begin).normalized(), reach);
}
bool any_crosses(const ForceInput& in, const Vec3& from, const Vec3& way) {
    const double distance = way.norm();
    for (std::size_t m = 0; distance > 0 && m < in.meshes.size(); ++m)
        if (crosses(in, m, from, way / distance, distance)) return true;
    return false;
}

// The vector from the nearest point of a face to a place; see AtPlate (plate_geometry.cpp) for plates.
Vec3 from_face(const WallState& walls, std::int32_t f, const Vec3& place) {
    const FaceRecord& face = walls.faces[f];
    Vec3 out = place - face.axis;
    out.z() = 0;
    if (walls.ends.empty() || walls.ends[f].two_sided == 0) {
        if (face.radius == 0) return (face.normal.dot(place) - face.level) * face.normal;
        const double rho = out.norm();
        return rho > 0 ? Vec3((rho - face.radius) / rho * out) : Vec3(-face.radius, 0, 0);
    }
    const FaceEnd& end = walls.ends[f];
    out = Vec3(out.x() * end.out_x, out.y() * end.out_y, 0);
    const double rho = out.norm();
    if (rho > 0) out /= rho;
    const Vec3 across = face.radius > 0 ? Vec3((rho - face.radius) * out)
                                        : Vec3((face.normal.dot(place) - face.level) * face.normal);
    const Vec3 back = end.gap > 0 ? Vec3(std::min(0.0, rho - end.gap) * out)
                                  : Vec3(std::min(0.0, end.along.dot(place) - end.level) * end.along);
    return across + back;
}

const MeshNear* near_of(const MeshLists& lists, std::int32_t grain, std::int32_t mesh) {
    const auto less = [mesh](const MeshNear& one, std::int32_t wanted) {
        return one.grain != wanted ? one.grain < wanted : one.mesh < mesh;
    };
    const auto found = std::lower_bound(lists.near.begin(), lists.near.end(), grain, less);
    return found != lists.near.end() && found->grain == grain && found->mesh == mesh ? &*found : nullptr;
}

// The group of the contacts of a species with a wall.
std::int32_t group_at(const ForceInput& in, std::int32_t species, std::int32_t wall) {
    return wall < faces_of(in) ? in.rules.group_of_wall[species]
                               : static_cast<std::int32_t>(in.rules.group_of(wall - faces_of(in), species));
}

// Whether a species has the same law with the same parameters at two walls.
bool is_one_law(const ForceInput& in, std::int32_t species, std::int32_t one, std::int32_t other) {
    const ContactGroup &a = in.rules.groups[group_at(in, species, one)],
                       &b = in.rules.groups[group_at(in, species, other)];
    if (a.law != b.law || a.rolling != b.rolling || a.number_size() != b.number_size()) return false;
    const auto kind = [&](const ContactGroup& group, std::int32_t wall) {
        const std::int32_t mesh = wall - faces_of(in);
        return group.row[group.of_mesh ? mesh * in.rules.species + species : species];
    };
    const std::int32_t of_a = kind(a, one), of_b = kind(b, other);
    const auto equal = [&](const LawParameters& p, const LawParameters& q) {
        const std::size_t count = p.kinds > 0 ? p.values.size() / p.kinds : 0;
        for (std::size_t k = 0; k < count; ++k)
            if (p.values[k * p.kinds + of_a] != q.values[k * q.kinds + of_b]) return false;
        return true;
    };
    return equal(a.parameters, b.parameters) && equal(a.rolling_parameters, b.rolling_parameters);
}

}  // namespace

void Screens::find(const ForceInput& in, const ThreadContacts& contacts, Halo* halo) {
    gone_.clear(), left_out_.clear(), heirs_.clear();
    for (const ScreenWatch::Grain& one : contacts.screens.grains) look_at(in, contacts, one);
    look_between(in, contacts, halo);
    std::sort(gone_.begin(), gone_.end());
}

bool Screens::holds(const ScreenWatch::Pair& pair) const {
    return std::binary_search(gone_.begin(), gone_.end(), pair);
}

// The way begins at the first body, so that both threads of a pair find the same. Where x is periodic, the
// mesh may lie beside either body.
void Screens::look_between(const ForceInput& in, const ThreadContacts& contacts, Halo* halo) {
    for (const ScreenWatch::Pair& pair : contacts.screens.pairs) {
        const bool of_pairs = in.rules.groups[pair.group].of_pairs;
        std::int32_t first[kBlock], second[kBlock];
        std::fill_n(first, kBlock, pair.first);
        std::fill_n(second, kBlock, of_pairs ? pair.second : pair.first);
        Halo::Bodies at{first, second};
        if (halo && of_pairs) at = halo->find(first, second, 1);
        const Place& one = in.grains.place[at.first[0]];
        Place other;
        if (of_pairs) {
            other = in.grains.place[at.second[0]];
        } else {
            other = in.glued.place[pair.second];
            other.position += in.walls.faces[in.glued.face[pair.second]].axis;
        }
        Vec3 way = other.position - one.position;
        way.x() = wrapped(way.x(), in.rules.period);
        if (!(way.norm() < one.radius + other.radius)) continue;
        if (any_crosses(in, one.position, way) ||
            (in.rules.period > 0 && any_crosses(in, other.position, -way)))
            gone_.push_back(pair);
    }
}

void Screens::add_spot(const Place& grain, std::int32_t wall, std::int32_t triangle,
                       const TouchedPlace& touched) {
    spots_.push_back({wall, triangle, touched, std::llrint(touched.distance / (kEqual * grain.radius))});
}

void Screens::add_face(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain,
                       std::int32_t face) {
    const Place& place = in.grains.place[grain];
    const Vec3 out = from_face(in.walls, face, place.position);
    const double distance = out.norm();
    const FaceRecord& record = in.walls.faces[face];
    const bool endless = in.walls.ends.empty() || in.walls.ends[face].two_sided == 0;
    const bool flat = record.radius == 0 && endless;
    if (!(distance > 0 && distance < place.radius) || (flat && record.normal.dot(out) < 0)) return;
    add_spot(place, face, -1, {-out / distance, distance, flat});
    const std::int32_t group = in.rules.group_of_wall[in.grains.species[grain]];
    const std::int32_t c = contacts.tables[group].place_of(grain, face);
    if (c >= 0 && contacts.tables[group].touches(c)) before_.push_back({face, group, c, -out / distance});
}

void Screens::add_mesh(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain,
                       std::int32_t mesh) {
    const std::int32_t wall = faces_of(in) + mesh;
    const std::int32_t group = group_at(in, in.grains.species[grain], wall);
    const MeshLists& lists = contacts.meshes[group];
    const MeshNear* const near = near_of(lists, grain, mesh);
    if (!near) return;
    const Place& place = in.grains.place[grain];
    const WallPose& pose = in.walls.pose_of_mesh(mesh);
    find_touched(*near, lists, *in.meshes[mesh].surface, pose.at_rest(place.position), place.radius,
                 patches_);
    for (const Patch& patch : patches_.all())
        add_spot(place, wall, patch.triangle, {pose.turned_out(patch.normal), patch.distance, patch.on_face});
    const ContactTable& table = contacts.tables[group];
    for (std::int32_t number = 0; number < near->slots; ++number) {
        const std::int32_t c = near->contact[number];
        if (c == MeshNear::kNone || !table.touches(c)) continue;
        double kept[3];
        table.histories().get(c, in.rules.groups[group].law_size() + kNormalX, 3, kept);
        before_.push_back({wall, group, c, Vec3(kept[0], kept[1], kept[2])});
    }
}

void Screens::find_spots(const ForceInput& in, const ThreadContacts& contacts,
                         const ScreenWatch::Grain& watched) {
    spots_.clear(), before_.clear();
    for (const std::int32_t wall : contacts.screens.walls_of(watched))
        wall < faces_of(in) ? add_face(in, contacts, watched.grain, wall)
                            : add_mesh(in, contacts, watched.grain, wall - faces_of(in));
}

// What is screened itself screens others too, so that the answer changes evenly as the grain moves.
bool Screens::is_screened(const ForceInput& in, const Place& grain, const Spot& spot) const {
    const bool of_face = spot.wall < faces_of(in);
    const Vec3 point = grain.position + spot.place.distance * spot.place.normal;
    for (const Spot& other : spots_) {
        const bool other_face = other.wall < faces_of(in);
        if (other.wall == spot.wall || (of_face && other_face)) continue;
        const bool nearer = other.order != spot.order ? other.order < spot.order : other.wall < spot.wall;
        if (nearer && stands_for(other.place, spot.place, grain.radius)) return true;
        if (other_face && in.walls.ends.empty()) {
            const FaceRecord& face = in.walls.faces[other.wall];
            const double least = kEqual * grain.radius;
            if (face.radius == 0 && face.normal.dot(point) - face.level < -least) return true;
            if (face.radius > 0 && (point - face.axis).head<2>().norm() - face.radius > least) return true;
        }
        if (!other_face && other.order < spot.order &&
            crosses(in, static_cast<std::size_t>(other.wall - faces_of(in)), grain.position,
                    spot.place.normal, kBefore * spot.place.distance))
            return true;
    }
    return false;
}

void Screens::look_at(const ForceInput& in, const ThreadContacts& contacts,
                      const ScreenWatch::Grain& watched) {
    find_spots(in, contacts, watched);
    if (spots_.empty()) return;
    const std::int32_t grain = watched.grain;
    for (Spot& spot : spots_) {
        spot.counts = !is_screened(in, in.grains.place[grain], spot);
        if (spot.counts) continue;
        if (spot.wall < faces_of(in))
            gone_.push_back({in.rules.group_of_wall[in.grains.species[grain]], grain, spot.wall});
        else
            left_out_.push_back({grain, spot.wall, spot.triangle});
    }
    leave_to_heirs(in, contacts, grain);
}

void Screens::leave_to_heirs(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain) {
    for (Before& before : before_)
        before.goes_on = std::any_of(spots_.begin(), spots_.end(), [&](const Spot& spot) {
            return spot.counts && spot.wall == before.wall &&
                   spot.place.normal.dot(before.normal) > kSameNormal;
        });
    for (const Spot& spot : spots_) {
        if (!spot.counts) continue;
        const Before* nearest = nullptr;
        double largest = kSameNormal;
        bool is_old = false;
        for (const Before& before : before_) {
            const double cosine = spot.place.normal.dot(before.normal);
            is_old = is_old || (before.wall == spot.wall && cosine > kSameNormal);
            if (!before.goes_on && before.wall != spot.wall && cosine > largest)
                largest = cosine, nearest = &before;
        }
        if (is_old || !nearest || !is_one_law(in, in.grains.species[grain], spot.wall, nearest->wall))
            continue;
        Heir& heir = heirs_.emplace_back(Heir{grain, spot.wall, spot.place.normal, {}});
        contacts.tables[nearest->group].histories().get(
            nearest->place, 0, in.rules.groups[nearest->group].law_size(), heir.numbers.data());
    }
}

void Screens::leave_out(std::int32_t grain, std::int32_t wall, Patches& patches) const {
    for (const LeftOut& one : left_out_)
        if (one.grain == grain && one.wall == wall) patches.leave_out(one.triangle);
}

const Screens::Heir* Screens::heir(std::int32_t grain, std::int32_t wall, const Vec3& normal) const {
    for (const Heir& one : heirs_)
        if (one.grain == grain && one.wall == wall && one.normal.dot(normal) > kSameNormal) return &one;
    return nullptr;
}

}  // namespace grainreel
