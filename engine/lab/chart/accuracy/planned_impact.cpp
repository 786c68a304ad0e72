#include "engine/lab/chart/accuracy/planned_impact.hpp"

#include <fmt/format.h>

#include "engine/base/mathematics.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace {

std::string species_text(const char* name, double radius, double density) {
    return fmt::format("[[species]]\nname = \"{}\"\ndiameter = {:.17g}\ndensity = {:.17g}\n", name,
                       2 * radius, density);
}

std::string scene_text(const ImpactScene& impact) {
    const double second = impact.size_ratio * bench_radius;
    const double apart = 1.1 * (bench_radius + (impact.wall ? 0 : second));
    return "gravity = 0\n" + species_text("a", bench_radius, bench_density) +
           species_text("b", second, impact.density_ratio * bench_density) +
           fmt::format("[contact]\nrestitution = {:.17g}\nfriction = {:.17g}\n", impact.restitution,
                       impact.friction) +
           impact.law + "[container]\nshape = \"none\"\n" +
           fmt::format("[[grain]]\nspecies = \"a\"\nposition = [0, 0, 0]\nvelocity = [{:.17g}, 0, 0]\n",
                       impact.speed) +
           (impact.wall ? fmt::format("[[wall]]\npoint = [{:.17g}, 0, 0]\nnormal = [-1, 0, 0]\n", apart)
                        : "") +
           fmt::format("[[grain]]\nspecies = \"b\"\nposition = [{:.17g}, 0, 0]\n",
                       impact.wall ? -4 * second : apart) +
           "[run]\nduration = 1\n";
}

Vec3 momentum_of(const SmallWorld& world) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.grains.size(); ++i)
        sum += world.grains.mass(i) * world.grains.motion[i].velocity;
    return sum;
}

Vec3 angular_momentum_of(const SmallWorld& world) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.grains.size(); ++i) {
        sum += world.grains.mass(i) * world.grains.place[i].position.cross(world.grains.motion[i].velocity);
        sum += world.grains.inertia(i) * world.grains.motion[i].spin;
    }
    return sum;
}

}  // namespace

Plan plan_of(const ImpactScene& impact) {
    return make_plan(read_scene_text(scene_text(impact), "impact.toml"));
}

double usual_step() {
    ImpactScene impact;
    impact.friction = 0.5;
    const Plan plan = plan_of(impact);
    return plan.clock.step * std::sqrt(plan.between(0, 0).loading_stiffness / bench_stiffness);
}

Impact make_impact(const ImpactScene& impact, const Plan& plan, double step, double angle, double phase) {
    SmallWorld world(plan, 0.2 * bench_radius);
    world.plan.clock.step = step;
    const Vec3 velocity = impact.speed * Vec3(math::cos(angle), math::sin(angle), 0);
    world.add(-phase * step * velocity, velocity);
    if (impact.wall) {
        world.add_plane(Vec3(bench_radius, 0, 0), Vec3(-1, 0, 0));
    } else {
        const double radius = impact.size_ratio * bench_radius;
        world.add(Vec3(bench_radius + radius, 0, 0), Vec3::Zero(),
                  {radius, impact.density_ratio * bench_density, 1});
    }
    world.start();
    Impact result;
    result.energy_before = world.kinetic();
    const Vec3 momentum = momentum_of(world), angular = angular_momentum_of(world);
    const double time = impact.wall ? plan.wall[0].contact_time : plan.between(0, 1).contact_time;
    world.run(static_cast<std::int64_t>(std::ceil(2 * time / step)) + 5);
    result.energy = world.kinetic();
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(world.grains.size()); ++id) {
        result.velocity[id] = world.velocity(id);
        result.spin[id] = world.spin(id);
    }
    result.momentum_change = (momentum_of(world) - momentum).norm() / momentum.norm();
    result.angular_change = (angular_momentum_of(world) - angular).norm() / (momentum.norm() * bench_radius);
    return result;
}

DrivenContact::DrivenContact(const PairPlan& pair)
    : law_(law_kernel(pair.model)), parameters_(law_.parameters({pair})) {
    history_.shape(law_.history_size, law_.number_size);
    history_.resize(1);
    for (int c = 0; c < kBlock; ++c) {
        touch_.inverse_mass.set(c, 2 / bench_mass(), law_.number_size);
        touch_.effective_radius.set(c, 0.5 * bench_radius, law_.number_size);
    }
}

// Cayley's vector of a rotation: first from the last normal to this one by the shortest way, then the
// twist. For tan(twist / 2) half the twist is used, as in the step loop.
Vec3 DrivenContact::turn_of(const Move& move) const {
    const Vec3& k = move.normal;
    const Vec3 tilt = normal_.cross(k) / (1 + normal_.dot(k));
    return tilt + 0.5 * move.twist * (k + k.cross(tilt));
}

void DrivenContact::move(const Move& move) {
    const Vec3 turn = turn_of(move);
    normal_ = move.normal;
    constexpr double step = 1;  // s, so that slips are velocities too; laws without a dashpot do not use it
    for (int axis = 0; axis < 3; ++axis) {
        touch_.normal[axis].set(0, move.normal[axis], law_.number_size);
        touch_.velocity[axis].set(0, move.slip[axis] / step, law_.number_size);
        touch_.turn[axis].set(0, turn[axis], law_.number_size);
    }
    touch_.overlap.set(0, move.overlap, law_.number_size);
    touch_.touching = 1;
    LawInput in{};
    in.count = 1;
    in.touch = &touch_;
    in.parameters = &parameters_;
    in.step = step;
    in.history_stride = law_.history_size;
    law_.step_one_kind(in, history_.of_block(0), force_);
}

double DrivenContact::normal_force() const {
    return force_.normal.get(0, law_.number_size);
}

Vec3 DrivenContact::tangential() const {
    const auto along = [this](int axis) { return force_.tangential[axis].get(0, law_.number_size); };
    return {along(0), along(1), along(2)};
}

}  // namespace grainreel
