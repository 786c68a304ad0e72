// Tests of energy on closed paths of normal force and slip. A tangential law whose stiffness depends on the
// normal force can make energy on each round (Elata & Berryman 1996, Mech. Mater. 24, 229). The laws are
// called by hand.
#include <gtest/gtest.h>

#include <functional>

#include "engine/laws/hertz-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/mindlin-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using namespace HWY_NAMESPACE;
using std::numbers::pi;

// Normal force divided by its largest value, and slip divided by mu N / K at that value. The place on a round
// goes from 0 to 1.
struct Point {
    double normal, slip;
};
using Path = std::function<Point(double)>;

// The slip goes forward under the full force and back under `low` of it, or the other way round.
Path rectangle(double slip, double low, bool backwards) {
    return [=](double share) {
        const double corner = 4 * (backwards ? 1 - share : share);
        if (corner < 1) return Point{1, slip * corner};
        if (corner < 2) return Point{1 - (1 - low) * (corner - 1), slip};
        if (corner < 3) return Point{low, slip * (3 - corner)};
        return Point{low + (1 - low) * (corner - 3), 0};
    };
}
Path ellipse(double slip, double swing, double phase) {
    return [=](double share) {
        const double t = 2 * pi * share;
        return Point{(1 + swing * std::sin(t + phase)) / (1 + swing), slip * std::sin(t)};
    };
}

std::vector<Path> paths() {
    std::vector<Path> all;
    for (const double slip : {0.02, 0.05, 0.1, 0.13, 0.17, 0.2, 0.3, 0.5, 1.0, 2.0}) {
        for (const double low : {0.05, 0.1, 0.16, 0.2, 0.25, 0.35, 0.5, 0.8}) {
            all.push_back(rectangle(slip, low, false));
            all.push_back(rectangle(slip, low, true));
        }
        for (const double swing : {0.3, 0.7, 0.95}) {
            for (int k = 0; k < 12; ++k) all.push_back(ellipse(slip, swing, k * pi / 6));
        }
    }
    return all;
}

template <class Tangential, class Normal>
struct Led {
    typename Tangential::template Parameters<double> tangential;
    typename Normal::template Parameters<double> normal;
    double stiffness, largest;  // N/m and N, at the largest force
    std::function<double(double)> overlap_at = [](double) { return 1e-5; };  // m, by the share of that force

    // The energy that the last of four rounds made, divided by the energy exchanged in it, which is half of
    // |T ds|.
    double made(const Path& path, double friction) const {
        constexpr int steps = 1000;
        typename Tangential::template History<double> history{};
        Touch<double> touch{};
        touch.normal = {0, 0, 1};
        touch.effective_radius = kRadius;
        double force = 0, slip = path(0).slip, spent = 0, turned = 0;
        for (int n = 1; n <= 4 * steps; ++n) {
            if (n == 3 * steps + 1) spent = turned = 0;
            const Point at = path(static_cast<double>(n % steps) / steps);
            const double along = (at.slip - slip) * friction * largest / stiffness;
            touch.slip = {along, 0, 0};
            touch.overlap = overlap_at(at.normal);
            const double now = Tangential::force(tangential, normal, history, touch, at.normal * largest).x;
            spent += 0.5 * (force + now) * along;
            turned += 0.25 * std::abs((force + now) * along);
            force = now;
            slip = at.slip;
        }
        return -spent / turned;
    }
    double most_made(double friction) const {
        double most = -1;
        for (const Path& path : paths()) most = std::max(most, made(path, friction));
        return most;
    }
};

constexpr double kFriction = 0.5;

// The law has no state function and makes a little energy, most where a small slip comes back under a small
// normal force.
TEST(ClosedLoop, IncrementalSlipMakesAFewPerCentAtWorst) {
    struct Row {
        double gamma, bound;
    };
    for (const Row& row : {Row{1.0 / 3, 0.035}, Row{1, 0.06}, Row{2, 0.08}}) {
        PairPlan pair = walton_braun_pair(1, kFriction);
        pair.gamma = row.gamma;
        const Led<IncrementalSlip, WaltonBraun> led{IncrementalSlip::from(pair), WaltonBraun::from(pair),
                                                    pair.tangential_stiffness, 1};
        const double made = led.most_made(kFriction);
        std::printf("[ measured ] gamma %.2f: a round makes at most %.4f of what it turns over\n", row.gamma,
                    made);
        EXPECT_LT(made, row.bound);
        EXPECT_GT(made, 0.8 * row.bound);
    }
}

TEST(ClosedLoop, LinearSpringMakesNone) {
    const PairPlan pair = walton_braun_pair(1, kFriction);
    const Led<LinearSpring, WaltonBraun> led{LinearSpring::from(pair), WaltonBraun::from(pair),
                                             pair.tangential_stiffness, 1};
    EXPECT_LT(led.most_made(kFriction), 1e-9);
}

// Mindlin's law makes none because its force shrinks with the contact. Without that it would make up to an
// eighth of the energy exchanged.
TEST(ClosedLoop, MindlinMakesNone) {
    PairPlan pair = walton_braun_pair(1, kFriction);
    pair.modulus = 1e8;
    pair.tangential_ratio = 0.8;
    const double overlap = 1e-5, radius = std::sqrt(kRadius * overlap);
    const double largest = 4.0 / 3 * pair.modulus * radius * overlap;
    Led<Mindlin, Hertz> led{Mindlin::from(pair), Hertz::from(pair), 0.8 * 2 * pair.modulus * radius, largest};
    led.overlap_at = [=](double share) { return overlap * std::pow(share, 2.0 / 3); };
    EXPECT_LT(led.most_made(kFriction), 1e-9);
}

}  // namespace
}  // namespace grainreel
