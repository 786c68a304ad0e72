#include "engine/step/forces/match_patches.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

constexpr double kSameNormal = 0.86602540378443865;  // cos 30 degrees: a contact turns by less in a step

int count_of(const std::vector<Patch>& patches) {
    return static_cast<int>(std::min<std::size_t>(patches.size(), kMostPatches));
}

}  // namespace

const std::vector<MatchedPatch>& PatchMatcher::match(const ForceInput& in,
                                                     const std::vector<MeshWall>& meshes,
                                                     const ContactGroup& group, const MeshNear& near,
                                                     const MeshLists& lists, const ContactTable& table) {
    matched_.clear();
    fault_.reset();
    const Place& grain = in.grains.place[near.grain];
    const WallPose& pose = in.walls.pose_of_mesh(near.mesh);
    const Vec3 centre = pose.at_rest(grain.position);
    // A triangle comes nearer by no more than the grain has moved in the body's frame.
    const double reach = grain.radius + (centre - near.centre).norm();
    const NearTriangle* triangle = lists.triangles.data() + near.first;
    const NearTriangle* const end = triangle + near.count;
    if (!(triangle->distance < reach)) return matched_;

    patches_.begin(*meshes[near.mesh].surface, centre, grain.radius);
    for (; triangle != end && triangle->distance < reach; ++triangle) patches_.add(triangle->number);
    patches_.find();
    if (patches_.all().empty()) return matched_;
    normals_.clear(), distances_.clear();
    for (const Patch& patch : patches_.all()) {
        normals_.push_back(pose.turned * patch.normal);
        distances_.push_back(patch.distance);
    }
    find_before(group, near, table);
    look_for_crossings(in, near, pose);
    find_owners();
    put_together(static_cast<std::int32_t>(in.walls.faces.size()) + near.mesh);
    return matched_;
}

void PatchMatcher::find_before(const ContactGroup& group, const MeshNear& near, const ContactTable& table) {
    before_.clear();
    const int behind = group.law_size();
    for (std::int32_t number = 0; number < kMostPatches; ++number) {
        const std::int32_t c = near.contact[number];
        if (c == MeshNear::kNone || !table.touches(c)) continue;
        const auto kept = [&](int k) { return table.histories().get(c, behind + k); };
        const Vec3 normal(kept(kNormalX), kept(kNormalY), kept(kNormalZ));
        if (normal.isZero(0)) continue;  // not computed yet
        before_.push_back({number, static_cast<std::int32_t>(kept(kTriangle)), normal, kept(kForce)});
    }
}

// The patch that a contact goes on with; -1 for none.
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

// A centre has come through the surface if it now sees it on the other side, and nearer than it can have come
// in any other way. Such a grain ends the run. While grains settle or grow, it is pushed back, as by a plane.
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

void PatchMatcher::put_together(std::int32_t wall) {
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
        matched_.push_back(
            {number, goes_on, {wall, patch.triangle, distances_[p], patch.at, normals_[p], before}});
    }
}

}  // namespace grainreel
