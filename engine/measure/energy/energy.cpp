#include "engine/measure/energy/energy.hpp"

#include <algorithm>
#include <numeric>

#include "engine/step/step_loop.hpp"

namespace grainreel {

Kinetic kinetic_energy(const Grains& grains) {
    Kinetic sum;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        sum.translation += 0.5 * grains.motion[i].velocity.squaredNorm() * grains.mass(i);
        sum.rotation += 0.5 * grains.motion[i].spin.squaredNorm() * grains.inertia(i);
    }
    return sum;
}

double gravitational_energy(const Grains& grains, const Vec3& gravity) {
    double sum = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
        sum -= grains.mass(i) * gravity.dot(grains.place[i].position);
    return sum;
}

double wall_work(const Grains& grains) {
    return std::accumulate(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
}

ContactSummary summarise_contacts(const StepLoop& loop, std::int64_t step) {
    ContactSummary sum;
    loop.visit_contacts(step, [&](const ContactView& c) {
        sum.stored += c.stored_energy;
        sum.largest_overlap = std::max(sum.largest_overlap, c.overlap / c.smaller_radius);
        if (c.normal_force > 0) sum.carrying += c.second >= 0 ? 2 : 1;
    });
    return sum;
}

double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step) {
    const Kinetic kinetic = kinetic_energy(grains);
    return kinetic.translation + kinetic.rotation + gravitational_energy(grains, around.gravity) +
           summarise_contacts(loop, step).stored;
}

}  // namespace grainreel
