// The peers' bed with their law, with ours, and without friction.
#include "engine/lab/bench/peers_cases.hpp"

#include <algorithm>
#include <cmath>

#include "engine/lab/bench/peers_bed.hpp"

namespace grainreel {
namespace {

constexpr int all = 10125, big_ones = 1125;

// Fewer grains stand in a narrower box, as high as the whole bed.
BenchBed bed_of(int particles, const Plan& plan) {
    const int count = std::min(particles, all), big = count * big_ones / all;
    const double side = 0.02 * std::sqrt(count / static_cast<double>(all));
    const PeersBed bed = peers_bed(7, count - big, big, side);
    return {plan, peers_surroundings(bed, plan), peers_grains(bed)};
}

// The same stiffness, restitution and step in Walton and Braun's law.
Plan walton_braun(TangentialLaw tangential) {
    Plan plan = peers_plan();
    for (auto* kinds : {&plan.grain, &plan.wall}) {
        for (PairPlan& pair : *kinds) {
            pair.model.normal = NormalForce::walton_braun_corrected;
            pair.model.tangential = tangential;
            pair.restitution = 0.9;
            pair.unloading_stiffness = pair.loading_stiffness / (0.9 * 0.9);
            pair.tangential_stiffness = 0.8 * pair.loading_stiffness;
            pair.gamma = 1.0 / 3;
            if (tangential == TangentialLaw::none) pair.friction = 0;
        }
    }
    return plan;
}

double side(const BenchBed& bed) {
    double widest = 0;
    for (const Face& face : bed.around.faces) widest = std::max(widest, std::abs(face.point.x()));
    return 2 * widest;
}

BenchCase like_the_peers(const std::string& name, const std::string& about, BenchBed (*bed)(int)) {
    return {name, about, all, -60000, 0, 0, {{"settled", 60000}, {"rising", 10000}, {"vibrated", 20000}},
            bed,  side};
}

}  // namespace

std::vector<BenchCase> peers_cases() {
    return {
        like_the_peers("bed10k", "the peers' bed: spring-dashpot with friction, in three phases",
                       [](int n) { return bed_of(n, peers_plan()); }),
        like_the_peers("bed10k-walton-braun", "the same with Walton-Braun, corrected, and incremental slip",
                       [](int n) { return bed_of(n, walton_braun(TangentialLaw::incremental_slip)); }),
        like_the_peers("frictionless", "the same with Walton-Braun, corrected, without friction",
                       [](int n) { return bed_of(n, walton_braun(TangentialLaw::none)); })};
}

}  // namespace grainreel
