#include "engine/start/start_origin.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/surroundings.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Where container and clock of another run have a grain, up to rounding.
bool same_grain(const Grains& one, std::size_t i, const Grains& other, std::size_t j, const Vec3& offset) {
    constexpr double kRounding = 1e-9;  // over the radius
    const Place &here = one.place[i], &there = other.place[j];
    // A periodic depth may have wrapped x.
    const Vec3 apart = here.position - there.position - offset;
    return here.radius == there.radius && std::hypot(apart.y(), apart.z()) < kRounding * here.radius &&
           one.species[i] == other.species[j];
}

bool same_grains(const Grains& one, const Grains& other, const Vec3& offset) {
    if (one.size() != other.size()) return false;
    std::vector<std::size_t> index(other.size());
    for (std::size_t j = 0; j < other.size(); ++j) index[other.id[j]] = j;
    for (std::size_t i = 0; i < one.size(); ++i)
        if (!same_grain(one, i, other, index[one.id[i]], offset)) return false;
    return true;
}

}  // namespace

bool StartOrigin::walls_moved() const {
    const Pose pose = around.motion.at(step);
    const auto moved = [&](const Body& body) {
        return body.has_own_motion() && !(body.at(pose) == BodyPose{});
    };
    const std::vector<Body> bodies = bodies_of(scene);
    return !pose.offset.isZero(0) || !pose.velocity.isZero(0) ||
           std::any_of(bodies.begin(), bodies.end(), moved) ||
           std::any_of(bodies.begin(), bodies.end(),
                       [](const Body& body) { return !body.velocity.isZero(0); });
}

std::optional<StartOrigin> origin_of(const fs::path& checkpoint) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label) return std::nullopt;
    try {
        const std::string name = checkpoint.string();
        const Assignments sets{{"start.method=file", name},
                               {"start.file=" + fs::absolute(checkpoint).string(), name},
                               {"start.keep_clock=true", name}};
        StartOrigin origin;
        origin.scene = read_scene_text(label->scene, checkpoint, sets, measurable_in);
        // How its grains came to be is not known; in a container they fell, as the plan takes it.
        if (origin.scene.container.shape != Container::Shape::none) origin.scene.start = {};
        origin.plan = make_plan(origin.scene, StartFacts());
        origin.around = make_surroundings(origin.scene, origin.plan);
        origin.step = label->step;
        return origin;
    } catch (const UserError&) {
        return std::nullopt;
    }
}

std::optional<StartOrigin> origin_beside(const Scene& scene, const Grains& grains) {
    const fs::path checkpoint = fs::path(scene.start.file).parent_path() / "checkpoint.grs";
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label) return std::nullopt;
    try {
        Scene there = scene;
        there.start.file = checkpoint.string();
        // The table has its grains where they were in the laboratory.
        if (!same_grains(grains, grains_from_checkpoint(there), label->wall_offset)) return std::nullopt;
    } catch (const UserError&) {
        return std::nullopt;
    }
    return origin_of(checkpoint);
}

bool act_alike(const PairPlan& one, const PairPlan& other) {
    const ContactModel &a = one.model, &b = other.model;
    if (a.normal != b.normal || a.tangential != b.tangential || a.own != b.own) return false;
    if (a.normal == NormalForce::hertz)
        return one.modulus == other.modulus && one.tangential_ratio == other.tangential_ratio;
    // Where the restitution depends on speed, the plan's unloading stiffness is only that of one speed.
    const bool by_speed = one.hardening > 0 || !one.restitution_table.empty();
    return one.loading_stiffness == other.loading_stiffness &&
           (by_speed || one.unloading_stiffness == other.unloading_stiffness) &&
           one.hardening == other.hardening && one.restitution_table == other.restitution_table &&
           one.tangential_stiffness == other.tangential_stiffness;
}

bool same_glued_grains(const GluedGrains& one, const GluedGrains& other) {
    if (one.size() != other.size() || one.face != other.face) return false;
    for (std::size_t g = 0; g < one.size(); ++g)
        if (one.place[g].position != other.place[g].position || one.place[g].radius != other.place[g].radius)
            return false;
    return true;
}

}  // namespace grainreel
