#include "engine/step/forces/law_input.hpp"

#include <algorithm>
#include <cmath>

#include "engine/mesh/surface.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/geometry/wall_point.hpp"

namespace grainreel {

namespace {

// The kind of each contact of a chunk, and of the copies that fill its last block.
const std::int32_t* kinds_of(const ForceInput& in, const ContactGroup& group, const Chunk& chunk,
                             std::int32_t* kind) {
    static constexpr std::int32_t kOne[kChunk] = {};
    if (!group.needs_rows()) return kOne;
    const auto& species = in.grains.species;
    for (int c = 0; c < chunk.count; ++c) {
        const std::int32_t one = species[chunk.first[c]];
        kind[c] = group.row[group.of_pairs ? one * in.rules.species + species[chunk.second[c]] : one];
    }
    for (int c = 0; group.of_mesh && c < chunk.count; ++c)
        kind[c] = group.row[mesh_of(chunk.second[c]) * in.rules.species + species[chunk.first[c]]];
    std::fill_n(kind + chunk.count, kChunk - chunk.count, 0);
    return kind;
}

// Computes the geometry of each contact.
void touch(const ForceInput& in, const ContactGroup& group, const GeometryInput& geometry,
           const MeshTouch* mesh, ChunkMemory& memory) {
    if (group.of_pairs) return touch_pairs(geometry, in.rules.period, memory.touch);
    if (group.of_mesh) return touch_meshes(geometry, mesh, memory.touch);
    if (!group.of_glued) return touch_walls(geometry, in.walls, memory.touch);
    find_faces(in.glued, geometry.second, geometry.count, memory.face);
    touch_glued(geometry, {in.glued, in.walls, in.rules.period}, memory.face, memory.touch);
}

// Contacts that are screened do not touch.
void part_screened(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded,
                   TouchChunk& touch) {
    const auto number = static_cast<std::int32_t>(&group - in.rules.groups.data());
    for (int c = 0; c < chunk.count; ++c) {
        if (!touch.touches(c) || !in.screens->screens(number, chunk.first[c], chunk.second[c])) continue;
        touch.touching &= ~(std::uint64_t{1} << c);
        touch.overlap.set(c, -1, rounded ? sizeof(float) : sizeof(double));
    }
}

}  // namespace

LawInput law_input(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded,
                   ChunkMemory& memory) {
    const GeometryInput geometry{.grains = &in.grains,
                                 .first = chunk.first_at,
                                 .second = chunk.second_at,
                                 .count = chunk.count,
                                 .wants = group.rolling ? Wants::rolling : wants_of(*group.law),
                                 .arms = in.rules.arms,
                                 .step = in.times.since,
                                 .turns_for = group.law->at_mid_step ? in.times.turns : 0,
                                 .rolling = &memory.rolling,
                                 .mass = group.law->uses_mass,
                                 .radius = group.law->uses_radius || group.rolling,
                                 .rounded = rounded};
    touch(in, group, geometry, chunk.mesh, memory);
    memory.touch.touching &= bits_of_first(chunk.count);  // without the copies that fill the last block
    if (in.screens && in.screens->any() && !group.of_mesh)
        part_screened(in, group, chunk, rounded, memory.touch);
    return {.count = chunk.count,
            .touch = &memory.touch,
            .kind = kinds_of(in, group, chunk, memory.kind),
            .parameters = &group.parameters,
            .step = in.times.since,
            .ahead = in.times.ahead,
            .history_stride = group.history_size(),
            .rolling = &memory.rolling};
}

namespace {

constexpr double kSameNormal = 0.86602540378443865;  // cos 30 degrees; a contact turns by less in a step

int count_of(const std::vector<Patch>& patches) {
    return static_cast<int>(std::min<std::size_t>(patches.size(), kMostPatches));
}

// `at` is in m, in the body's frame; the normals are in the frame of the scene.
void set_touch(const WallPose& pose, std::int32_t triangle, double distance, const Vec3& at,
               const Vec3& normal, const Vec3& before, MeshTouch& touch) {
    touch.normal = normal;
    touch.distance = distance;
    touch.normal_before = before;
    touch.triangle = triangle;
    touch.velocity = pose.mean_velocity(at);
    touch.spin = pose.spin;
}

// The number of a mesh among all walls.
std::int32_t wall_of(const ForceInput& in, const MeshNear& near) {
    return static_cast<std::int32_t>(in.walls.faces.size()) + near.mesh;
}

// The contact of a grain with a mesh that touched in the last step, if it was just one.
struct LoneContact {
    std::int32_t number;
    Vec3 normal;
};
std::optional<LoneContact> lone_contact(const ContactGroup& group, const MeshNear& near,
                                        const ContactTable& table) {
    std::int32_t found = -1;
    for (std::int32_t number = 0; number < near.slots; ++number) {
        const std::int32_t c = near.contact[number];
        if (c == MeshNear::kNone || !table.touches(c)) continue;
        if (found >= 0) return std::nullopt;
        found = number;
    }
    if (found < 0) return std::nullopt;
    double kept[3];
    table.histories().get(near.contact[found], group.law_size() + kNormalX, 3, kept);
    return LoneContact{found, Vec3(kept[0], kept[1], kept[2])};
}

}  // namespace

void find_touched(const MeshNear& near, const MeshLists& lists, const Surface& surface, const Vec3& centre,
                  double radius, Patches& patches) {
    const double reach = radius + (centre - near.centre).norm();
    const NearTriangle* const first = lists.triangles.data() + near.first;
    patches.begin(surface, centre, radius);
    for (const NearTriangle* t = first; t != first + near.count && t->distance < reach; ++t)
        patches.add(t->number);
    patches.find();
}

const std::vector<MatchedPatch>& PatchMatcher::match(const ForceInput& in,
                                                     const std::vector<MeshWall>& meshes,
                                                     const ContactGroup& group, const MeshNear& near,
                                                     const MeshLists& lists, const ContactTable& table) {
    fault_.reset();
    const Place& grain = in.grains.place[near.grain];
    const WallPose& pose = in.walls.pose_of_mesh(near.mesh);
    const Vec3 centre = pose.at_rest(grain.position);
    // A triangle has come nearer by no more than the grain has moved in the body's frame.
    const double gone = (centre - near.centre).norm(), reach = grain.radius + gone;
    if (!(lists.triangles[near.first].distance < reach)) {
        matched_.clear();
        return matched_;
    }
    const Asked asked{*meshes[near.mesh].surface, pose, centre, grain.radius, gone, reach};
    const bool watched = in.screens && near.watched != MeshNear::kNone;
    if (!watched && find_lone(group, near, lists, table, asked)) return matched_;

    matched_.clear();
    find_touched(near, lists, asked.surface, centre, grain.radius, patches_);
    if (watched) in.screens->leave_out(near.grain, wall_of(in, near), patches_);
    if (patches_.all().empty()) return matched_;
    normals_.clear(), distances_.clear();
    for (const Patch& patch : patches_.all()) {
        normals_.push_back(pose.turned_out(patch.normal));
        distances_.push_back(patch.distance);
    }
    find_before(group, near, table);
    look_for_crossings(in, near, pose);
    find_owners();
    put_together(in, near, pose);
    return matched_;
}

// Handles the case of most grains at rest on a mesh: one plane is within reach, and the only contact goes on.
// The result is that of the general way. Returns false in all other cases.
bool PatchMatcher::find_lone(const ContactGroup& group, const MeshNear& near, const MeshLists& lists,
                             const ContactTable& table, const Asked& asked) {
    if (!(asked.gone < near.stays)) return false;
    const NearTriangle* const own = lists.triangles.data() + near.first;
    if (near.flat < near.count && own[near.flat].distance < asked.reach) return false;
    const std::int32_t triangle = own->number;
    const Vec3& out = asked.surface.normal(triangle);
    const double plane = out.dot(asked.centre - asked.surface.corner(triangle, 0)),
                 distance = std::abs(plane);
    if (!(plane * plane < asked.radius * asked.radius)) {
        matched_.clear();
        return true;
    }
    const std::optional<LoneContact> before = lone_contact(group, near, table);
    if (!before || !(distance > 0)) return false;
    const Vec3 normal = asked.pose.turned_out(plane > 0 ? Vec3(-out) : out);
    if (!(normal.dot(before->normal) > kSameNormal)) return false;
    matched_.resize(1);
    MatchedPatch& one = matched_.front();
    one.number = before->number;
    one.goes_on = true;
    set_touch(asked.pose, triangle, distance, asked.centre - plane * out, normal, before->normal, one.touch);
    return true;
}

void PatchMatcher::find_before(const ContactGroup& group, const MeshNear& near, const ContactTable& table) {
    before_.clear();
    const int behind = group.law_size();
    for (std::int32_t number = 0; number < near.slots; ++number) {
        const std::int32_t c = near.contact[number];
        if (c == MeshNear::kNone || !table.touches(c)) continue;
        double kept[kPatchNumbers];
        table.histories().get(c, behind, kPatchNumbers, kept);
        const Vec3 normal(kept[kNormalX], kept[kNormalY], kept[kNormalZ]);
        if (normal.isZero(0)) continue;  // not computed yet
        before_.push_back({number, static_cast<std::int32_t>(kept[kTriangle]), normal, kept[kForce]});
    }
}

// Number of the patch that a contact goes on with, or -1.
int PatchMatcher::patch_of(const Before& before) const {
    const int holder = patches_.holder_of(before.triangle);
    if (holder >= 0 && normals_[holder].dot(before.normal) > kSameNormal) return holder;
    int nearest = -1;
    double largest = kSameNormal;
    for (int p = 0; p < static_cast<int>(normals_.size()); ++p) {
        const double cosine = normals_[p].dot(before.normal);
        if (cosine > largest) largest = cosine, nearest = p;
    }
    return nearest;
}

void PatchMatcher::find_owners() {
    owner_.fill(-1);
    for (int b = 0; b < static_cast<int>(before_.size()); ++b) {
        const int p = patch_of(before_[b]);
        if (p < 0 || p >= kMostPatches) continue;
        if (owner_[p] < 0 || before_[b].force > before_[owner_[p]].force) owner_[p] = b;
    }
}

// A grain's centre has come through the surface if it now lies on the other side, so near that it cannot have
// come there in any other way. Such a grain ends the run. While grains settle or grow, it is pushed back, as
// by a plane.
void PatchMatcher::look_for_crossings(const ForceInput& in, const MeshNear& near, const WallPose& pose) {
    using Kind = MeshFault::Kind;
    constexpr double kOpposite = -0.5, kDeep = 0.5;  // cosine; of the radius
    const std::vector<Patch>& all = patches_.all();
    const Place& grain = in.grains.place[near.grain];
    const auto note = [&](Kind kind, const Patch& patch) {
        fault_ = {kind, in.grains.id[near.grain], near.mesh, patch.triangle, grain.position};
    };
    if (std::ssize(all) > kMostPatches) note(Kind::many_patches, all[0]);
    for (std::size_t p = 0; p < all.size(); ++p) {
        const Vec3 velocity = in.grains.motion[near.grain].velocity - pose.mean_velocity(all[p].at);
        const double way = std::max(kDeep * grain.radius, velocity.norm() * in.times.since);
        const bool flips =
            all[p].distance < way && std::any_of(before_.begin(), before_.end(), [&](const Before& before) {
                return before.normal.dot(normals_[p]) < kOpposite;
            });
        if (flips && in.times.drags)
            normals_[p] = -normals_[p], distances_[p] = -distances_[p];
        else if (flips || (!(all[p].distance > 0) && !in.times.drags))
            note(Kind::crossed, all[p]);
    }
}

void PatchMatcher::put_together(const ForceInput& in, const MeshNear& near, const WallPose& pose) {
    std::array<bool, kMostPatches> taken{};
    const std::vector<Patch>& all = patches_.all();
    for (int p = 0; p < count_of(all); ++p)
        if (owner_[p] >= 0) taken[before_[owner_[p]].number] = true;
    std::int32_t free = 0;
    for (int p = 0; p < count_of(all); ++p) {
        const Patch& patch = all[p];
        const bool goes_on = owner_[p] >= 0;
        while (!goes_on && taken[free]) ++free;
        const std::int32_t number = goes_on ? before_[owner_[p]].number : free++;
        const Vec3 before = goes_on ? before_[owner_[p]].normal : Vec3(0, 0, 0);
        MatchedPatch& matched = matched_.emplace_back(MatchedPatch{number, goes_on, {}});
        if (!goes_on && in.screens && near.watched != MeshNear::kNone)
            matched.heir = in.screens->heir(near.grain, wall_of(in, near), normals_[p]);
        set_touch(pose, patch.triangle, distances_[p], patch.at, normals_[p], before, matched.touch);
    }
}

}  // namespace grainreel
