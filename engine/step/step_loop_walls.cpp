// What the step loop sums up of the walls, where somebody asks for it.
#include "engine/step/step_loop.hpp"

namespace grainreel {

void StepLoop::tally_walls(const WallScale& scale, std::int64_t step) {
    if (members_[0].walls.tally != nullptr) {
        for (Member& m : members_) m.tally.begin_anew();
        return;
    }
    for (Member& m : members_) {
        m.tally.begin(around_.faces, scale);
        m.walls.tally = &m.tally;
    }
    // The forces at the start: the first half kick is theirs.
    const Pose pose = around_.motion.at(step);
    members_[0].tally.begin_evaluation(last_share());
    visit_contacts(step, [&](const ContactView& c) {
        if (c.second >= 0) return;
        const std::int32_t face = -1 - c.second;
        const Face& at = around_.faces[static_cast<std::size_t>(face)];
        members_[0].tally.add(face, c.normal_force * c.normal + c.tangential, c.normal_force,
                              c.point - at.point - at.displacement(pose));
    });
}

void StepLoop::go_on_tallying(const WallSums& before, const WallScale& scale) {
    for (Member& m : members_) {
        m.tally.begin(around_.faces, scale);
        m.walls.tally = &m.tally;
    }
    members_[0].tally.take(before);
}

// Of a step, that the forces of its last evaluation act.
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
