#include "engine/lab/bench/peers_bed.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/base/team.hpp"
#include "engine/lab/bench/bench_case.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

// The Mersenne twister as Python seeds and reads it (Matsumoto & Nishimura 1998, init_by_array of 2002), so
// that the bed is the same as the peers'.
class PythonRandom {
  public:
    explicit PythonRandom(std::uint32_t seed) {
        state_[0] = 19650218;
        for (std::uint32_t i = 1; i < n; ++i) state_[i] = 1812433253u * mixed(i) + i;
        std::uint32_t i = 1;
        for (std::uint32_t k = 0; k < n; ++k) state_[i] = (state_[i] ^ (mixed(i) * 1664525u)) + seed, next(i);
        for (std::uint32_t k = 0; k < n - 1; ++k)
            state_[i] = (state_[i] ^ (mixed(i) * 1566083941u)) - i, next(i);
        state_[0] = 0x80000000u;
    }
    double uniform(double low, double high) {
        const double a = word() >> 5, b = word() >> 6;
        return low + (high - low) * ((a * 67108864.0 + b) / 9007199254740992.0);
    }

  private:
    static constexpr std::uint32_t n = 624, m = 397;

    std::uint32_t mixed(std::uint32_t i) const { return state_[i - 1] ^ (state_[i - 1] >> 30); }
    void next(std::uint32_t& i) {
        if (++i < n) return;
        state_[0] = state_[n - 1];
        i = 1;
    }
    void renew() {
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t y = (state_[k] & 0x80000000u) | (state_[(k + 1) % n] & 0x7fffffffu);
            state_[k] = state_[(k + m) % n] ^ (y >> 1) ^ (y & 1 ? 0x9908b0dfu : 0);
        }
        used_ = 0;
    }
    std::uint32_t word() {
        if (used_ == n) renew();
        std::uint32_t y = state_[used_++];
        y ^= y >> 11;
        y ^= (y << 7) & 0x9d2c5680u;
        y ^= (y << 15) & 0xefc60000u;
        return y ^ (y >> 18);
    }

    std::array<std::uint32_t, n> state_{};
    std::uint32_t used_ = n;
};

// The number as printed with %.8g and read again.
double eight_digits(double x) {
    return std::stod(fmt::format("{:.8g}", x));
}

// `count` sites of a cubic lattice from height z on, each shifted by up to 4 % of the diameter. Sets z to
// the next free layer.
std::vector<Vec3> lattice(int count, double diameter, double side, double& z, PythonRandom& random) {
    const double apart = diameter * 1.12;
    const int across = static_cast<int>((side - diameter * 1.02) / apart) + 1;
    const double edge = (side - (across - 1) * apart) / 2;
    const auto shift = [&] { return random.uniform(-0.04, 0.04) * diameter; };
    std::vector<Vec3> sites;
    for (; static_cast<int>(sites.size()) < count; z += apart) {
        for (int site = 0; site < across * across && static_cast<int>(sites.size()) < count; ++site) {
            const double x = edge + site / across * apart + shift();
            const double y = edge + site % across * apart + shift();
            const double height = z + shift();
            sites.emplace_back(eight_digits(x), eight_digits(y), eight_digits(height));
        }
    }
    return sites;
}

}  // namespace

PeersBed peers_bed(std::uint32_t seed, int small_count, int big_count, double side) {
    PeersBed bed;
    bed.side = side;
    PythonRandom random(seed);
    double z = 1.2e-3;
    bed.big_ones = lattice(big_count, kPeersBig, bed.side, z, random);
    z -= 0.3e-3;
    bed.small_ones = lattice(small_count, kPeersSmall, bed.side, z, random);
    return bed;
}

Grains peers_grains(const PeersBed& bed) {
    Grains grains;
    grains.reserve(bed.small_ones.size() + bed.big_ones.size());
    const Vec3 corner(bed.side / 2, bed.side / 2, 0);
    std::int32_t id = 0;
    for (const Vec3& x : bed.small_ones) grains.add(id++, 0, x - corner, kPeersSmall / 2, bed.density);
    for (const Vec3& x : bed.big_ones) grains.add(id++, 1, x - corner, kPeersBig / 2, bed.density);
    return grains;
}

Plan peers_plan() {
    PairPlan pair;
    pair.loading_stiffness = pair.unloading_stiffness = 1000;
    pair.tangential_stiffness = 285.7;
    pair.normal_damping = 2634;
    pair.tangential_damping = 1317;
    pair.friction = 0.5;
    pair.attraction = true;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::linear_spring, false};
    Plan plan;
    plan.grain.assign(4, pair);
    plan.wall.assign(2, pair);
    plan.clock.step = 2e-6;
    plan.clock.steps_per_period = 20000;
    plan.clock.initial_phase = 0.75;  // with no ramp this gives a (1 - cos wt)
    return plan;
}

Surroundings peers_surroundings(const PeersBed& bed, const Plan& plan) {
    Container box;
    box.shape = Container::Shape::box;
    box.half_width = bed.side / 2;
    box.depth = bed.side;
    box.height = 0.2;
    box.lid = false;
    Drive drive;
    drive.present = true;
    drive.frequency = 25;
    drive.amplitude = 1.19e-3;
    drive.phase = plan.clock.initial_phase;
    drive.ramp = 0;
    drive.moves = Drive::Moves::floor;
    Surroundings around;
    around.faces = container_faces(box, drive);
    around.motion = DriveMotion(drive, plan.clock);
    around.gravity = {0, 0, -9.81};
    around.skin = 0.0002;
    return around;
}

namespace {

constexpr int kOneBed = 10125, kBigOnes = 1125;
constexpr double kSofter = 16;  // springs are softer by this factor; even so, weight makes overlaps below 1 %
constexpr double kTime = 0.16;  // s, of settling
constexpr std::int64_t kLook = 500;  // steps between two calls of the watcher

Plan soft_plan() {
    Plan plan = peers_plan();
    for (auto* kinds : {&plan.grain, &plan.wall})
        for (PairPlan& pair : *kinds) {
            pair.loading_stiffness /= kSofter;
            pair.unloading_stiffness /= kSofter;
            pair.tangential_stiffness /= kSofter;
            pair.normal_damping /= std::sqrt(kSofter);
            pair.tangential_damping /= std::sqrt(kSofter);
        }
    plan.clock.step *= std::sqrt(kSofter);
    return plan;
}

}  // namespace

SettledBed settled_bed(int grains, int threads, const std::function<bool(double)>& watcher) {
    const int count = std::min(grains, kOneBed), big = count * kBigOnes / kOneBed;
    SettledBed settled;
    settled.side = 0.02 * std::sqrt(count / static_cast<double>(kOneBed));
    const PeersBed start = peers_bed(7, count - big, big, settled.side);
    const Plan plan = soft_plan();
    Surroundings around = peers_surroundings(start, plan);
    around.motion = DriveMotion(Drive{}, plan.clock);
    BenchBed bed{plan, around, peers_grains(start)};
    Team team(threads);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    loop.restart();
    const auto steps = static_cast<std::int64_t>(kTime / plan.clock.step);
    for (std::int64_t step = 0; step < steps; step += kLook) {
        if (!watcher(static_cast<double>(step) / static_cast<double>(steps))) return {};
        loop.run(step, kLook, plan.clock.step, 0);
    }
    const int k =
        static_cast<int>(std::lround(std::sqrt(std::max(1.0, grains / static_cast<double>(kOneBed)))));
    settled.grains = k > 1 ? copied(bed, bed.grains, settled.side, k).grains : bed.grains;
    settled.side *= k;
    for (const Place& place : settled.grains.place)
        settled.height = std::max(settled.height, place.position.z() + place.radius);
    return settled;
}

}  // namespace grainreel
