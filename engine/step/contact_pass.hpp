// The contact pass: finds the listed pairs that touch, computes each contact's force into a slot of its own,
// then hands the slots to the grains in a fixed order (see step_loop.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/laws/touch.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/neighbours.hpp"

namespace grainreel {

// Force and torque of one contact: `force` acts on the second grain, its opposite on the first. The torque on
// either is -arm * turning, with turning = k x T.
struct PairForce {
    Vec3 force;         // N
    double first_arm;   // m, from the first grain's centre to where T acts
    Vec3 turning;       // N
    double second_arm;  // m
};
static_assert(sizeof(PairForce) == 64, "one cache line a contact");

// What one thread keeps of its own range of grains.
struct ThreadContacts {
    struct Pair {
        std::int32_t slot, first, second;
    };
    std::vector<Pair> touching;          // by rising first, then second
    std::vector<PairForce> forces;       // one for each
    std::vector<std::int32_t> crossing;  // those whose second grain belongs to a later thread
};

template <class Law>
class ContactPass {
  public:
    using History = typename Law::History;
    using Parameters = typename Law::Parameters;

    ContactPass(const std::vector<PairPlan>& plan, std::size_t species, LeverArms arms)
        : species_(species), arms_(arms) {
        for (const PairPlan& pair : plan) parameters_.emplace_back(pair);
    }

    NeighbourList list;
    std::vector<History> history;       // one a listed pair
    std::vector<std::uint8_t> touched;  // likewise: touched in the last step

    // A fresh list without any contact.
    void clear_history() {
        history.assign(list.size(), History{});
        touched.assign(list.size(), 0);
    }

    void find_touching(const Grains& grains, std::int32_t begin, std::int32_t end, double period,
                       ThreadContacts& mine) {
        mine.touching.resize(list.start[end] - list.start[begin]);  // room for all; cut below
        ThreadContacts::Pair* next = mine.touching.data();
        const Place* place = grains.place.data();
        for (std::int32_t i = begin; i < end; ++i) {
            const Vec3 centre = place[i].position;
            const double radius = place[i].radius;
            for (std::int32_t slot = list.start[i], last = list.start[i + 1]; slot < last; ++slot) {
                const std::int32_t j = list.partner[slot];
                Vec3 apart = place[j].position - centre;
                apart.x() = nearest_image(apart.x(), period);
                const double reach = radius + place[j].radius;
                const bool touches = apart.squaredNorm() < reach * reach;
                *next = {slot, i, j};
                next += touches;
                if (touched[slot] > touches) forget(slot);
            }
        }
        mine.touching.resize(next - mine.touching.data());
    }

    void compute(const Grains& grains, double step, double period, std::int32_t end, ThreadContacts& mine) {
        mine.forces.resize(mine.touching.size());
        mine.crossing.clear();
        for (std::size_t c = 0; c < mine.touching.size(); ++c) {
            const ThreadContacts::Pair pair = mine.touching[c];
            touched[pair.slot] = 1;
            mine.forces[c] = pair_force(grains, step, period, pair);
            if (pair.second >= end) mine.crossing.push_back(static_cast<std::int32_t>(c));
        }
    }

    const Parameters& parameters(const Grains& grains, std::int32_t i, std::int32_t j) const {
        return parameters_[grains.species[i] * species_ + grains.species[j]];
    }

  private:
    void forget(std::int32_t slot) {
        history[slot] = History{};
        touched[slot] = 0;
    }

    PairForce pair_force(const Grains& grains, double step, double period, const ThreadContacts::Pair& pair) {
        const auto [slot, i, j] = pair;
        const Place &one = grains.place[i], &two = grains.place[j];
        Vec3 apart = two.position - one.position;
        apart.x() = nearest_image(apart.x(), period);
        const double distance = std::sqrt(apart.squaredNorm());
        Touch touch;
        const double inverse_distance = 1 / distance;
        touch.normal = apart * inverse_distance;
        touch.overlap = one.radius + two.radius - distance;
        // Arms to the plane through the spheres' circle of intersection; they sum to the distance, which is
        // what keeps angular momentum. The original program took the radii.
        double first_arm = one.radius, second_arm = two.radius;
        if (arms_ == LeverArms::contact_plane) {
            first_arm =
                0.5 * (distance + (one.radius - two.radius) * (one.radius + two.radius) * inverse_distance);
            second_arm = distance - first_arm;
        }
        fill_motion(grains, step, i, j, first_arm, second_arm, touch);
        const auto force = Law::force(parameters(grains, i, j), history[slot], touch);
        PairForce result;
        result.force = touch.normal * force.normal;
        result.first_arm = first_arm;
        result.second_arm = second_arm;
        if constexpr (Law::rubs) {
            result.force += force.tangential;
            result.turning = touch.normal.cross(force.tangential);
        } else {
            result.turning = Vec3::Zero();
        }
        return result;
    }

    static void fill_motion([[maybe_unused]] const Grains& grains, [[maybe_unused]] double step,
                            [[maybe_unused]] std::int32_t i, [[maybe_unused]] std::int32_t j,
                            [[maybe_unused]] double first_arm, [[maybe_unused]] double second_arm,
                            [[maybe_unused]] Touch& touch) {
        const Vec3& k = touch.normal;
        if constexpr (Law::uses_velocity) {
            touch.effective_mass = 1 / (grains.motion[i].inverse_mass + grains.motion[j].inverse_mass);
            const Vec3 v = grains.end_velocity[i] - grains.end_velocity[j];
            touch.closing_speed = k.dot(v);
            if constexpr (Law::rubs) {
                const Vec3 rolling = grains.end_spin[i] * first_arm + grains.end_spin[j] * second_arm;
                touch.slip_velocity = v - k * touch.closing_speed + rolling.cross(k);
            }
        }
        if constexpr (Law::rubs) {
            const Vec3 v = grains.motion[i].velocity - grains.motion[j].velocity;
            const Vec3 &wi = grains.spin[i].rate, &wj = grains.spin[j].rate;
            touch.slip = (v - k * k.dot(v) + (wi * first_arm + wj * second_arm).cross(k)) * step;
            touch.twist = 0.5 * (wi + wj).dot(k) * step;
        }
    }

    std::size_t species_;
    LeverArms arms_;
    std::vector<Parameters> parameters_;  // species x species
};

// Sums the slots into the grains [begin, end) of thread `member`.
template <bool rubs>
void gather(const std::vector<ThreadContacts>& threads, int member, std::int32_t begin, std::int32_t end,
            Grains& grains) {
    for (std::int32_t i = begin; i < end; ++i) grains.force[i].setZero();
    if constexpr (rubs) {
        for (std::int32_t i = begin; i < end; ++i) grains.torque[i].setZero();
    }
    const auto add_second = [&](std::int32_t j, const PairForce& f) {
        grains.force[j] += f.force;
        if constexpr (rubs) grains.torque[j] -= f.second_arm * f.turning;
    };
    for (int earlier = 0; earlier < member; ++earlier) {
        const ThreadContacts& theirs = threads[earlier];
        for (const std::int32_t c : theirs.crossing) {
            const std::int32_t j = theirs.touching[c].second;
            if (j >= begin && j < end) add_second(j, theirs.forces[c]);
        }
    }
    const ThreadContacts& mine = threads[member];
    for (std::size_t c = 0; c < mine.touching.size(); ++c) {
        const ThreadContacts::Pair& pair = mine.touching[c];
        const PairForce& f = mine.forces[c];
        grains.force[pair.first] -= f.force;
        if constexpr (rubs) grains.torque[pair.first] -= f.first_arm * f.turning;
        if (pair.second < end) add_second(pair.second, f);
    }
}

}  // namespace grainreel
