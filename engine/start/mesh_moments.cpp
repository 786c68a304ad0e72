#include "engine/start/mesh_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

// s: when it has turned by so much (rad), or `end`.
double time_of_angle(const BodyTurn& turn, double angle, double end) {
    if (std::abs(turn.angle_at(end)) <= angle) return end;
    double low = 0, high = end;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (std::abs(turn.angle_at(middle)) < angle ? low : high) = middle;
    }
    return high;
}

}  // namespace

bool move_alike(const Body& one, const Body& other, bool drive_moves) {
    return (!drive_moves || one.driven == other.driven) && one.velocity == other.velocity &&
           one.turn == other.turn && one.path == other.path;
}

std::vector<std::int64_t> moments_of(const Body& body, const Scene& scene, const Plan& plan) {
    std::vector<double> times{0};
    const double end = scene.run.duration;
    for (int k = 1; k <= kMomentsOfMotion; ++k) {
        const double share = static_cast<double>(k) / kMomentsOfMotion;
        if (body.turn) times.push_back(time_of_angle(*body.turn, 2 * std::numbers::pi * share, end));
        if (body.path) times.push_back(share * std::min(end, body.path->last()));
        if (!body.velocity.isZero(0)) times.push_back(share * end);
    }
    if (body.driven && plan.moving_walls && scene.drive.present)
        for (int k = 0; k < 8; ++k)
            times.push_back(std::min(end, (scene.drive.ramp + k / 8.0) / scene.drive.frequency));
    std::vector<std::int64_t> steps;
    for (const double time : times) steps.push_back(std::llround(time / plan.clock.step));
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

}  // namespace grainreel
