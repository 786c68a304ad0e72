// What the step loop sums up of the walls, where somebody asks for it.
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

// m, of each wall's point at rest.
std::vector<double> heights_of_walls(const Surroundings& around) {
    std::vector<double> heights;
    for (const Face& face : around.faces) heights.push_back(face.point.z());
    for (const MeshWall& mesh : around.meshes) heights.push_back(mesh.point.z());
    return heights;
}

// m, from a wall's point to a place.
Vec3 arm_at(const Surroundings& around, std::size_t wall, const Pose& pose, const Vec3& place) {
    if (wall >= around.faces.size()) {
        const MeshWall& mesh = around.meshes[wall - around.faces.size()];
        return place - mesh.body.at(pose).moved(mesh.point);
    }
    const Face& face = around.faces[wall];
    if (face.body.has_own_motion()) return place - face.body.at(pose).moved(moment_point(face));
    return place - face.point - face.displacement(pose);
}

}  // namespace

void StepLoop::tally_walls(const WallScale& scale, std::int64_t step) {
    if (members_[0].walls.tally != nullptr) {
        for (Member& m : members_) m.tally.begin_anew();
        return;
    }
    for (Member& m : members_) {
        m.tally.begin(heights_of_walls(around_), scale);
        m.walls.tally = &m.tally;
    }
    // The forces at the start: the first half kick is theirs.
    const Pose pose = around_.motion.at(step);
    members_[0].tally.begin_evaluation(last_share());
    visit_contacts(step, [&](const ContactView& c) {
        if (c.second >= 0) return;
        const std::int32_t wall = -1 - c.second;
        members_[0].tally.add(wall, c.normal_force * c.normal + c.tangential, c.normal_force,
                              arm_at(around_, static_cast<std::size_t>(wall), pose, c.point));
    });
}

void StepLoop::go_on_tallying(const WallSums& before, const WallScale& scale) {
    for (Member& m : members_) {
        m.tally.begin(heights_of_walls(around_), scale);
        m.walls.tally = &m.tally;
    }
    members_[0].tally.take(before);
}

// Share of a step for which the forces of its last evaluation act.
double StepLoop::last_share() const {
    return scheme_.acts(scheme_.stages.size() - 1);
}

WallSums StepLoop::wall_sums() const {
    WallSums all;
    for (const Member& m : members_) m.tally.add_to(all);
    all.scale = members_[0].tally.scale();
    all.felt = last_share() > 0 ? scheme_.stages.back().kick / last_share() : 0;
    return all;
}

}  // namespace grainreel
