// Grains against faces, with the same laws. Walls enter with their own position and velocity at the same time
// levels as the grains': the end of the step for position and damping, the step's displacement for slip.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/state/container_faces.hpp"
#include "engine/step/contact_pass.hpp"

namespace grainreel {

template <class Law>
class WallPass {
  public:
    using History = typename Law::History;
    using Parameters = typename Law::Parameters;

    WallPass(const std::vector<PairPlan>& plan, const std::vector<Face>& faces, LeverArms arms)
        : faces_(faces), arms_(arms) {
        for (const PairPlan& pair : plan) parameters_.emplace_back(pair);
    }

    std::vector<WallNeighbour> list;  // by rising grain, then face
    std::vector<History> history;
    std::vector<std::uint8_t> touched;

    void clear_history() {
        history.assign(list.size(), History{});
        touched.assign(list.size(), 0);
    }

    // Adds the walls' forces to the grains [begin, end). `before` and `now`: the walls at the step's two
    // ends.
    void apply(Grains& grains, double step, const Pose& before, const Pose& now, std::int32_t begin,
               std::int32_t end) {
        const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
        std::size_t entry = std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin();
        for (; entry < list.size() && list[entry].grain < end; ++entry) {
            touch_wall(grains, entry, step, before, now);
        }
    }

    const Parameters& parameters(const Grains& grains, std::int32_t i) const {
        return parameters_[grains.species[i]];
    }

  private:
    void touch_wall(Grains& grains, std::size_t entry, double step, const Pose& before, const Pose& now) {
        const std::int32_t i = list[entry].grain;
        const Face& face = faces_[list[entry].face];
        const Place& place = grains.place[i];
        const Vec3 offset = face.moves ? now.offset : Vec3::Zero();
        const FaceDistance at = distance_to(face, offset, place.position);
        if (at.distance >= place.radius) {
            if (touched[entry]) {
                history[entry] = History{};
                touched[entry] = 0;
            }
            return;
        }
        touched[entry] = 1;
        Touch touch;
        touch.normal = -at.normal;
        touch.overlap = place.radius - at.distance;
        const double arm = arms_ == LeverArms::contact_plane ? at.distance : place.radius;
        const Vec3 wall_step = face.moves ? Vec3(now.offset - before.offset) : Vec3::Zero();
        const Vec3 wall_velocity = face.moves ? now.velocity : Vec3::Zero();
        fill_motion(grains, i, arm, wall_velocity, wall_step, step, touch);
        const auto force = Law::force(parameters(grains, i), history[entry], touch);
        Vec3 on_wall = touch.normal * force.normal;
        if constexpr (Law::rubs) {
            on_wall += force.tangential;
            grains.torque[i] -= arm * touch.normal.cross(force.tangential);
        }
        grains.force[i] -= on_wall;
        if (face.moves) grains.wall_work[i] -= on_wall.dot(wall_velocity) * step;
    }

    static void fill_motion([[maybe_unused]] const Grains& grains, [[maybe_unused]] std::int32_t i,
                            [[maybe_unused]] double arm, [[maybe_unused]] const Vec3& wall_velocity,
                            [[maybe_unused]] const Vec3& wall_step, [[maybe_unused]] double step,
                            [[maybe_unused]] Touch& touch) {
        const Vec3& k = touch.normal;
        if constexpr (Law::uses_velocity) {
            touch.effective_mass = 1 / grains.motion[i].inverse_mass;
            const Vec3 v = grains.end_velocity[i] - wall_velocity;
            touch.closing_speed = k.dot(v);
            if constexpr (Law::rubs) {
                touch.slip_velocity = v - k * touch.closing_speed + (grains.end_spin[i] * arm).cross(k);
            }
        }
        if constexpr (Law::rubs) {
            const Vec3 moved = grains.motion[i].velocity * step - wall_step;
            const Vec3& spin = grains.spin[i].rate;
            touch.slip = moved - k * k.dot(moved) + (spin * (arm * step)).cross(k);
            touch.twist = 0.5 * spin.dot(k) * step;
        }
    }

    const std::vector<Face>& faces_;
    LeverArms arms_;
    std::vector<Parameters> parameters_;  // one a species
};

}  // namespace grainreel
