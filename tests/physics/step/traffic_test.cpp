// Tests of grains that leave and enter: the step in which they do, the same bits on any number of threads,
// and the account of their energy.
#include "engine/state/traffic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "engine/base/binary.hpp"
#include "engine/measure/energy.hpp"
#include "engine/start/restart.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

constexpr double kGravity = 9.81;  // m/s2

std::uint64_t state_of(const HandMadeBed& w) {
    std::ostringstream out;
    write_state(out, w.step, w.grains, *w.loop);
    return std::hash<std::string>()(out.str());
}

void expect_same(const std::vector<Departure>& a, const std::vector<Departure>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].step, b[i].step) << i;
        EXPECT_EQ(a[i].id, b[i].id) << i;
        EXPECT_EQ(a[i].position, b[i].position) << i;
        EXPECT_EQ(a[i].velocity, b[i].velocity) << i;
    }
}

struct Fall {
    const char* name;
    Integrator integrator;
    // Number of steps of free fall that are counted in addition: leapfrog of the original program has z_n =
    // z_0 + v n dt - g dt^2 n (n + 1) / 2, and the others have the parabola itself.
    double lag;
};
class FreeFall : public testing::TestWithParam<Fall> {};

// z_n = z_0 + v t - g t^2 / 2 falls below the plane in step n and not before.
TEST_P(FreeFall, LeavesInTheStepOfTheClosedForm) {
    const double dt = 1e-4, up = 0.3, start = 0.05, plane = -0.1;
    HandMadeBed w = make_world(walton_braun_pair(0.9, 0.3), dt);
    w.plan.integrator = GetParam().integrator;
    w.around.gravity = {0, 0, -kGravity};
    w.around.exits = {exit_below(plane)};
    w.grains.add(0, 0, Vec3(0, 0, start), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(0.1, 0, start + 10), kRadius, kDensity);
    w.grains.motion[0].velocity = {0, 0, up};
    w.start();
    const auto height = [&](std::int64_t n) {
        const double t = static_cast<double>(n) * dt;
        return start + up * t - kGravity * t * (t + GetParam().lag * dt) / 2;
    };
    std::int64_t expected = 0;
    while (height(expected) >= plane) ++expected;
    ASSERT_GT(std::abs(height(expected) - plane), 1e-7) << "not decided by rounding";
    ASSERT_GT(std::abs(height(expected - 1) - plane), 1e-7);
    w.run(expected - 1);
    EXPECT_EQ(w.grains.size(), 2u);
    w.run(10);
    const std::vector<Departure> gone = w.loop->take_departures();
    ASSERT_EQ(gone.size(), 1u);
    EXPECT_EQ(gone[0].step, expected);
    EXPECT_EQ(gone[0].id, 0);
    EXPECT_NEAR(gone[0].position.z(), height(expected), 1e-12);
    ASSERT_EQ(w.grains.size(), 1u);
    EXPECT_EQ(w.grains.id[0], 1);
    EXPECT_TRUE(w.loop->take_departures().empty());
}

INSTANTIATE_TEST_SUITE_P(Traffic, FreeFall,
                         testing::Values(Fall{"velocity_verlet", Integrator::velocity_verlet, 0},
                                         Fall{"leapfrog", Integrator::leapfrog, 1},
                                         Fall{"position_verlet", Integrator::position_verlet, 0},
                                         Fall{"forest_ruth", Integrator::forest_ruth, 0},
                                         Fall{"gear", Integrator::gear, 0}),
                         [](const auto& one) { return one.param.name; });

TEST(Exits, ARegionIsWhereAllItsHalfSpacesAre) {
    // The unit cube.
    const Exit cube{{{Vec3(1, 0, 0), 1},
                     {Vec3(0, 1, 0), 1},
                     {Vec3(0, 0, 1), 1},
                     {Vec3(-1, 0, 0), 0},
                     {Vec3(0, -1, 0), 0},
                     {Vec3(0, 0, -1), 0}}};
    EXPECT_TRUE(cube.holds(Vec3(0.5, 0.9, 0.1)));
    EXPECT_FALSE(cube.holds(Vec3(0.5, 1.1, 0.1)));
    EXPECT_FALSE(cube.holds(Vec3(0.5, 0.9, -0.1)));
    EXPECT_FALSE(Exit().holds(Vec3(0, 0, 0)));
}

// Grains slide along a rough plane under gravity that leans and is fifty times that of the Earth. They leave
// at a line, together and alone, in contact and free.
constexpr double kExitLine = 0.02;  // m
HandMadeBed chute(int threads, double restitution = 0.7, double friction = 0.3,
                  Integrator integrator = Integrator::velocity_verlet) {
    PairPlan pair = walton_braun_pair(restitution, friction);
    HandMadeBed w = make_world(pair, 0.05 * std::sqrt(sphere_mass() / kStiffness) * std::numbers::pi);
    w.team = std::make_unique<Team>(threads);
    w.plan.wall[0].friction = 0.5 * friction;
    w.around.gravity = {0, 300, -400};
    w.around.faces = {floor_face()};
    w.plan.integrator = integrator;
    w.around.exits = {{{{Vec3(0, -1, 0), -kExitLine}}}};  // beyond y = kExitLine
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-1e-4, 1e-4);
    for (int i = 0; i < 240; ++i)
        w.grains.add(i, 0,
                     Vec3(4.3e-3 * (i % 6) + shift(random), -4.3e-3 * (i / 6 % 8) + shift(random),
                          2.2e-3 + 4.3e-3 * (i / 48) + shift(random)),
                     kRadius * (1 - 0.2 * ((i * 37) % 11) / 11.0), kDensity);
    w.start();
    return w;
}

// Schemes that move grains after the forces do not know which grains leave when a step's forces are computed.
class AnyScheme : public testing::TestWithParam<Integrator> {};
TEST_P(AnyScheme, IsTheSameOnAnyNumberOfThreads) {
    std::vector<Departure> gone;
    std::uint64_t bits = 0;
    for (const int threads : {1, 2, 3}) {
        HandMadeBed w = chute(threads, 0.7, 0.3, GetParam());
        w.run(4000);
        const std::vector<Departure> now = w.loop->take_departures();
        ASSERT_GT(now.size(), 60u);
        // No grain was inside at the end of an earlier step: it came no farther than a step takes it.
        for (const Departure& one : now)
            EXPECT_LT(one.position.y() - kExitLine, 1.01 * one.velocity.y() * w.plan.clock.step + 1e-9);
        if (threads == 1) gone = now, bits = state_of(w);
        expect_same(now, gone);
        EXPECT_EQ(state_of(w), bits) << threads << " threads";
    }
}
INSTANTIATE_TEST_SUITE_P(Traffic, AnyScheme,
                         testing::Values(Integrator::leapfrog, Integrator::position_verlet,
                                         Integrator::forest_ruth, Integrator::gear));

TEST(Traffic, IsTheSameOnAnyNumberOfThreadsWhoeverLooks) {
    constexpr std::int64_t kSteps = 4000;
    HandMadeBed one = chute(1);
    one.run(kSteps);
    const std::vector<Departure> gone = one.loop->take_departures();
    ASSERT_GT(gone.size(), 60u);
    ASSERT_LT(gone.size(), 220u);
    EXPECT_EQ(one.loop->traffic().left, std::ssize(gone));
    EXPECT_EQ(one.grains.size() + gone.size(), 240u);
    for (const int threads : {1, 2, 3}) {
        HandMadeBed other = chute(threads);
        double seen = 0;
        for (std::int64_t look = 0; other.step < kSteps; ++look) {
            other.run(std::min<std::int64_t>(1 + look * 37 % 200, kSteps - other.step));
            other.loop->visit_contacts(other.step, [&](const ContactView& c) { seen += c.overlap; });
        }
        EXPECT_GT(seen, 0);
        expect_same(other.loop->take_departures(), gone);
        EXPECT_EQ(state_of(other), state_of(one)) << threads << " threads";
    }
}

// No force acts between grains that are far apart, and a grain that leaves takes its energy along.
TEST(Traffic, OfFreeGrainsClosesToTheLastDigits) {
    HandMadeBed w = make_world(walton_braun_pair(0.9, 0.3), 1e-4);
    w.around.gravity = {0, 0, -kGravity};
    w.around.exits = {exit_below(0)};
    for (int i = 0; i < 20; ++i) {
        w.grains.add(i, 0, Vec3(0.01 * i, 0, 0.003 * i), kRadius, kDensity);
        w.grains.motion[i].spin = Vec3(i, 0, 3);
    }
    w.start();
    const double before = w.energy();
    for (int look = 0; look < 12; ++look) {
        w.run(100);
        EXPECT_NEAR(w.energy() + w.loop->traffic().energy_out, before, 1e-12 * before) << look;
    }
    EXPECT_EQ(w.loop->traffic().left, 20);
    EXPECT_EQ(w.grains.size(), 0u);
}

// Grains are elastic and smooth, so the energy that collisions exchange stays, up to the error of the step.
TEST(Traffic, OfCollidingGrainsKeepsTheEnergy) {
    HandMadeBed w = chute(1, 1, 0);
    const double before = w.energy();
    double turned_over = 0;
    for (int look = 0; look < 40; ++look) {
        w.run(100);
        const Kinetic kinetic = kinetic_energy(w.grains);
        turned_over = std::max(turned_over, kinetic.translation + w.loop->traffic().energy_out);
        EXPECT_NEAR(w.energy() + w.loop->traffic().energy_out, before, 1e-3 * std::abs(before)) << look;
    }
    EXPECT_GT(w.loop->traffic().left, 60);
}

// With losses the energy balances term by term. The bound is that of the vibrated bed (energy_balance_test),
// divided by the energy that was exchanged. Energy in the contacts of a grain that leaves goes with it and is
// not friction.
TEST(Traffic, BalancesTermByTerm) {
    HandMadeBed w = chute(1);
    EnergyBalance balance(w.around, w.grains, *w.loop, 0, w.plan.clock.step);
    double worst = 0;
    while (w.step < 4000) {
        w.run(1);
        balance.note(w.step);
        worst = std::max(worst, std::abs(balance.residual()));
        if (w.step == 2000) {
            w.loop->insert({{0, kRadius, kDensity, Vec3(0.01, -0.05, 0.02), Vec3(0, 1, -1), Vec3(0, 9, 0)}});
            w.loop->remove({100}, w.step);
        }
    }
    const EnergyTerms& t = balance.terms();
    ASSERT_GT(w.loop->traffic().left, 60);
    EXPECT_GT(t.lost(), 0);
    EXPECT_LT(worst, 1e-3 * (t.lost() + std::abs(t.left)));
}

// One grain lies on the floor, another falls onto it with a hundred times the Earth's gravity.
constexpr double kDropGravity = 100 * kGravity, kDropHeight = 4 * kRadius;
constexpr std::int64_t kDropSteps = 3000;
ComingGrain falling(double t) {
    return {0,
            kRadius,
            kDensity,
            Vec3(1e-4, 0, kDropHeight - kDropGravity * t * t / 2),
            Vec3(0, 0, -kDropGravity * t),
            Vec3(0, 0, 0)};
}
HandMadeBed drop(int threads) {
    HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 0.05 * std::sqrt(sphere_mass() / kStiffness));
    w.team = std::make_unique<Team>(threads);
    w.around.gravity = {0, 0, -kDropGravity};
    w.around.faces = {floor_face()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius), kRadius, kDensity);
    return w;
}
// Returns the world in which the second grain is there from the start.
HandMadeBed dropped() {
    HandMadeBed w = drop(1);
    w.grains.add(1, 0, falling(0).position, kRadius, kDensity);
    w.start();
    w.run(kDropSteps);
    return w;
}
void expect_close(const HandMadeBed& w, const HandMadeBed& wanted) {
    for (const std::int32_t id : {0, 1}) {
        EXPECT_LT((w.position(id) - wanted.position(id)).norm(), of_rounding(1e-9, 1e-5)) << id;
        EXPECT_LT((w.velocity(id) - wanted.velocity(id)).norm(), of_rounding(1e-6, 1e-2)) << id;
    }
}

// The grain acts as if it had been there all the time, whether it comes long before the two meet or two steps
// before.
TEST(Traffic, ANewGrainIsLikeOneThatWasAlwaysThere) {
    const HandMadeBed always = dropped();
    ASSERT_LT(always.velocity(0).x(), -1e-3) << "it has been hit";
    const double dt = always.plan.clock.step;
    const double meet = std::sqrt(2 * (kDropHeight - 3 * kRadius) / kDropGravity);
    for (const std::int64_t comes : {std::int64_t{300}, static_cast<std::int64_t>(meet / dt) - 2}) {
        std::uint64_t bits = 0;
        for (const int threads : {1, 2, 3}) {
            HandMadeBed w = drop(threads);
            w.start();
            w.run(comes);
            EXPECT_EQ(w.loop->insert({falling(static_cast<double>(comes) * dt)}), 1);
            ASSERT_EQ(w.grains.size(), 2u);
            const Traffic& traffic = w.loop->traffic();
            EXPECT_EQ(traffic.came, 1);
            const double energy = sphere_mass() * kDropGravity * kDropHeight;
            EXPECT_NEAR(traffic.energy_in, energy, 1e-12 * energy);
            w.run(kDropSteps - comes);
            expect_close(w, always);
            const std::uint64_t now = state_of(w);
            if (bits == 0) bits = now;
            EXPECT_EQ(now, bits) << threads << " threads";
        }
    }
}

// Grains that leave stand before the others in every list; the two grains meet as if the others had never
// been there.
TEST(Traffic, ListsCloseUpBehindThoseThatLeave) {
    const HandMadeBed alone = dropped();
    const double dt = alone.plan.clock.step;
    const double meet = std::sqrt(2 * (kDropHeight - 3 * kRadius) / kDropGravity);
    const std::int64_t leave = static_cast<std::int64_t>(meet / dt) - 4;
    for (const int threads : {1, 2}) {
        HandMadeBed w = drop(threads);
        w.around.skin = kRadius;
        w.grains.add(1, 0, falling(0).position, kRadius, kDensity);
        std::vector<std::int32_t> others;
        for (int i = 0; i < 12; ++i) {
            others.push_back(2 + i);
            w.grains.add(others.back(), 0, Vec3(0, -0.1 + 4.1e-3 * i, kRadius), kRadius, kDensity);
        }
        w.start();
        w.run(leave);
        const std::int64_t listed = w.loop->rebuilds();
        w.loop->remove(others, leave);
        ASSERT_EQ(w.grains.size(), 2u);
        EXPECT_EQ(w.loop->listed_pairs(), 1u);
        w.run(20);
        ASSERT_EQ(w.loop->rebuilds(), listed) << "they met by the lists that had been there";
        w.run(kDropSteps - leave - 20);
        expect_close(w, alone);
    }
}

// Two grains are pressed together and fly freely. When one leaves, nothing pushes the other any more, so it
// keeps the velocity that it has then.
TEST(Traffic, ForcesOfAGrainThatHasLeftDoNotAct) {
    for (const Integrator integrator :
         {Integrator::velocity_verlet, Integrator::leapfrog, Integrator::position_verlet}) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 0.05 * std::sqrt(sphere_mass() / kStiffness));
        w.plan.integrator = integrator;
        w.grains.add(0, 0, Vec3(0, 0, 0), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(1.99 * kRadius, 0, 0), kRadius, kDensity);
        w.grains.add(2, 0, Vec3(0, 0, 0.1), kRadius, kDensity);
        w.start();
        w.run(3);
        const Vec3 then = w.velocity(0);
        ASSERT_LT(then.x(), -1e-3) << "it was pushed";
        w.loop->remove({1}, w.step);
        w.run(10);
        EXPECT_EQ(w.velocity(0), then);
    }
}

TEST(Traffic, NoIdIsUsedTwice) {
    HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 1e-5);
    for (int i = 0; i < 4; ++i) w.grains.add(i, 0, Vec3(0.01 * i, 0, 0), kRadius, kDensity);
    w.start();
    w.loop->remove({3, 1, 17}, 0);
    EXPECT_EQ(w.grains.id, (std::vector<std::int32_t>{0, 2}));
    ComingGrain grain{0, kRadius, kDensity, Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    EXPECT_EQ(w.loop->insert({grain}), 4);
    w.loop->remove({0, 2, 4}, 0);
    EXPECT_EQ(w.grains.size(), 0u);
    w.run(10);  // no grain is there
    EXPECT_EQ(w.loop->insert({grain, grain}), 5);
    w.run(10);
    EXPECT_EQ(w.grains.id, (std::vector<std::int32_t>{5, 6}));
    const std::vector<Departure> gone = w.loop->take_departures();
    ASSERT_EQ(gone.size(), 5u);
    EXPECT_EQ(gone[0].id, 1);
    EXPECT_EQ(gone[1].id, 3);
}

// Grains enter a run that begins without any, on more threads than there are grains.
TEST(Traffic, MayBeginWithNobody) {
    std::uint64_t bits = 0;
    for (const int threads : {1, 2, 3}) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 1e-5);
        w.team = std::make_unique<Team>(threads);
        w.around.gravity = {0, 0, -kGravity};
        w.around.faces = {floor_face()};
        w.around.skin = 1e-3;
        w.start();
        for (int i = 0; i < 10; ++i) {
            w.loop->insert(
                {{0, kRadius, kDensity, Vec3(5e-3 * i, 0, 3 * kRadius), Vec3(0, 0, -1), Vec3(0, 0, 0)},
                 {0, kRadius, kDensity, Vec3(5e-3 * i, 0.01, 3 * kRadius), Vec3(0, 0, -1), Vec3(0, 0, 0)}});
            w.run(300);
        }
        EXPECT_EQ(w.grains.size(), 20u);
        for (const Place& place : w.grains.place) EXPECT_GT(place.position.z(), 0.5 * kRadius);
        const std::uint64_t now = state_of(w);
        if (bits == 0) bits = now;
        EXPECT_EQ(now, bits) << threads << " threads";
    }
}

// The run is saved after some grains left, and between an insertion and the step that follows it.
TEST(Traffic, GoesOnFromACheckpointToTheSameBits) {
    const auto add_some = [](HandMadeBed& w) {
        std::vector<ComingGrain> rain;
        for (int i = 0; i < 6; ++i)
            rain.push_back(
                {0, kRadius, kDensity, Vec3(4.3e-3 * i, -0.02, 0.03), Vec3(0, 0, -0.5), Vec3(0, 0, 0)});
        w.loop->insert(rain);
    };
    HandMadeBed whole = chute(1);
    whole.run(3000);
    add_some(whole);
    const std::uint64_t saved = state_of(whole);
    const std::int64_t left = whole.loop->traffic().left;
    ASSERT_GT(left, 5);
    whole.run(800);
    ASSERT_GT(whole.loop->traffic().left, left);
    for (const int threads : {1, 2, 3}) {
        HandMadeBed other = chute(threads);
        other.run(3000);
        add_some(other);
        ASSERT_EQ(state_of(other), saved);
        std::ostringstream lists;
        other.loop->save(lists);
        HandMadeBed on = chute(threads);
        on.grains = other.grains;
        on.loop = std::make_unique<StepLoop>(on.plan, on.around, on.grains, *on.team);
        const std::string bytes = lists.str();
        Bytes in(bytes);
        on.loop->load(in, other.step);
        ASSERT_FALSE(in.failed());
        ASSERT_EQ(in.left(), 0u);
        EXPECT_EQ(on.loop->traffic().came, 6);
        on.step = other.step;
        on.run(800);
        EXPECT_EQ(state_of(on), state_of(whole)) << threads << " threads";
        // Half of an account is refused.
        Bytes cut(std::string_view(bytes).substr(0, bytes.size() - 8));
        on.loop->load(cut, other.step);
        EXPECT_TRUE(cut.failed());
    }
}

}  // namespace
}  // namespace grainreel
