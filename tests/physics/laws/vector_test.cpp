// Tests of the vector code: against the same laws on plain doubles, and for the same bits at every width.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/friction-inl.hpp"
#include "engine/laws/hertz-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/mindlin-inl.hpp"
#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "engine/laws/walton_braun_corrected-inl.hpp"
#include "engine/laws/walton_braun_speed-inl.hpp"
#include "engine/step/lists/histories.hpp"
#include "tests/instruction_sets.hpp"
#include "tests/physics/one_lane.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using namespace HWY_NAMESPACE;

// The instruction set of the kernels in use.
std::int64_t used = 0;

// Calls work() for each instruction set, and notes which one it is.
template <class Work>
void for_each_width(const Work& work) {
    test::for_each_instruction_set([&](std::int64_t target) {
        used = target;
        work();
    });
}

// Whether kernels of this instruction set fuse multiplications with additions.
bool fuses() {
    return std::count(std::begin(test::fused_sets), std::end(test::fused_sets), used) > 0;
}

// Push collects the numbers of a history, and Take reads those of one kind from the table of parameters.
template <class R>
struct Push {
    std::vector<NumberOf<R>>& to;
    void operator()(R& x) const { to.push_back(x.value); }
    void turning(Triple<R>& t) const { (*this)(t.x), (*this)(t.y), (*this)(t.z); }
};
template <class R>
struct Take {
    mutable const NumberOf<R>* at;
    int kinds;
    void operator()(R& x) const { x = R::of(*at), at += kinds; }
};
std::vector<PairPlan> three_kinds() {
    std::vector<PairPlan> kinds;
    for (const double e : {0.5, 0.8, 0.98}) {
        PairPlan p = walton_braun_pair(e, 0.2 + 0.3 * e);
        p.normal_damping = 2000 * (1 - e);
        p.tangential_damping = 1000 * (1 - e);
        p.hardening = e == 0.8 ? 0 : 3e4 * (1 - e);
        p.attraction = e > 0.6;
        p.modulus = 1e8;
        p.hertz_damping = 1 - e;
        p.tangential_ratio = e;
        if (e == 0.8) p.restitution_table = {{0.01, 0.95}, {0.03, 0.7}, {0.1, 0.6}};
        p.gamma = e == 0.8 ? 0.7 : e == 0.5 ? 2 : 1.0 / 3.0;
        kinds.push_back(p);
    }
    return kinds;
}

// A crowd of contacts that slip, turn, part and meet again.
template <class Number>
class Crowd {
  public:
    explicit Crowd(std::size_t kinds) {
        for (int c = 0; c < kChunk; ++c) {
            set(touch.inverse_mass, c, 1e4 / (1.5 + one()));
            set(touch.effective_radius, c, 1e-3 * (1.5 + one()));
            kind[c] = static_cast<std::int32_t>(c % kinds);
            const Vec3 k = Vec3(one(), one(), one()).normalized();
            for (int a = 0; a < 3; ++a) set(touch.normal[a], c, k[a]);
        }
    }
    void move(int n) {
        for (int c = 0; c < kChunk; ++c) {
            Vec3 k(get(touch.normal[0], c), get(touch.normal[1], c), get(touch.normal[2], c));
            k = (k + 1e-3 * Vec3(one(), one(), one())).normalized();
            const bool apart = (n / 20 + c) % 9 == 0;
            set(touch.overlap, c, apart ? -1e-6 : 1e-5 * (1.1 + one()));
            touch.touching = (touch.touching & ~(std::uint64_t{1} << c)) | std::uint64_t{!apart} << c;
            for (int a = 0; a < 3; ++a) {
                set(touch.turn[a], c, 1e-3 * one());
                set(touch.normal[a], c, k[a]);
                set(touch.velocity[a], c, one());
            }
        }
    }
    template <class R>
    Touch<R> touch_of(int c) const {
        Touch<R> t{};
        t.normal = triple<R>(touch.normal, c);
        t.overlap = R::of(get(touch.overlap, c));
        t.turn = triple<R>(touch.turn, c);
        t.inverse_mass = R::of(get(touch.inverse_mass, c));
        t.effective_mass = R(1) / t.inverse_mass;
        t.effective_radius = R::of(get(touch.effective_radius, c));
        return t;
    }
    template <class R>
    static Triple<R> triple(const Row* from, int c) {
        return {R::of(get(from[0], c)), R::of(get(from[1], c)), R::of(get(from[2], c))};
    }
    static Number get(const Row& row, int c) { return row.of<Number>()[c]; }
    static void set(Row& row, int c, double value) { row.set(c, value, sizeof(Number)); }

    TouchChunk touch;
    std::int32_t kind[kChunk];

  private:
    double one() { return spread_(random_); }
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> spread_{-1, 1};
};

// The kernel's answer must be the scalar law's.
template <class Normal, class Tangential, class R>
void compare_at(NormalForce normal, TangentialLaw tangential, const std::vector<PairPlan>& kinds) {
    using Law = LawPair<Normal, Tangential>;
    using Number = NumberOf<R>;
    const Precision precision = std::is_same_v<Number, float> ? Precision::mixed : Precision::full;
    const LawKernel& kernel = law_kernel({normal, tangential, false, precision});
    const LawParameters parameters = kernel.parameters(kinds);
    Crowd<Number> crowd(kinds.size());
    ForceChunk force;
    Histories history;
    history.shape(kernel.history_size, kernel.number_size);
    history.resize(kChunk);
    std::vector<typename Law::template History<R>> expected(kChunk);
    const double step = 1e-6;
    for (int n = 0; n < 200; ++n) {
        crowd.move(n);
        const auto run = kinds.size() == 1 ? kernel.step_one_kind : kernel.step;
        run({kChunk, &crowd.touch, crowd.kind, &parameters, step, 0.5, kernel.history_size, nullptr},
            history.of_block(0), force);
        for (int c = 0; c < kChunk; ++c) {
            auto& h = expected[c];
            typename Law::template Force<R> f{0, {0, 0, 0}};
            if (crowd.get(crowd.touch.overlap, c) > 0) {
                typename Law::template Parameters<R> p;
                p.each(Take<R>{parameters.numbers<Number>() + crowd.kind[c], parameters.kinds});
                f = Law::force(p, h, crowd.template touch_of<R>(c),
                               Crowd<Number>::template triple<R>(crowd.touch.velocity, c), R(step), R(0.5));
            } else {
                h = {};
            }
            const auto expect = [&](const Row& row, R value) {
                ASSERT_EQ(crowd.get(row, c), value.value) << "step " << n << ", contact " << c;
            };
            ASSERT_NO_FATAL_FAILURE(expect(force.normal, f.normal));
            if (Law::rubs) {
                ASSERT_NO_FATAL_FAILURE(expect(force.tangential[0], f.tangential.x));
                ASSERT_NO_FATAL_FAILURE(expect(force.tangential[1], f.tangential.y));
                ASSERT_NO_FATAL_FAILURE(expect(force.tangential[2], f.tangential.z));
            }
            std::vector<Number> numbers;
            h.each(Push<R>{numbers});
            for (int k = 0; k < kernel.history_size; ++k) ASSERT_EQ(history.get(c, k), numbers[k]);
        }
    }
}

template <class Normal, class Tangential>
void compare(NormalForce normal, TangentialLaw tangential, const std::vector<PairPlan>& kinds) {
    if (fuses()) {
        compare_at<Normal, Tangential, OneLane<double, true>>(normal, tangential, kinds);
        compare_at<Normal, Tangential, OneLane<float, true>>(normal, tangential, kinds);
    } else {
        compare_at<Normal, Tangential, OneLane<double, false>>(normal, tangential, kinds);
        compare_at<Normal, Tangential, OneLane<float, false>>(normal, tangential, kinds);
    }
}

// There are 12,800 contact states for each combination and width.
TEST(VectorLaws, AreTheScalarLawsToTheLastBitAtEveryWidth) {
    for (const bool several : {false, true}) {
        auto kinds = three_kinds();
        if (!several) kinds.resize(1);
        for_each_width([&] {
            using WB = WaltonBraun;
            using WS = WaltonBraunSpeed;
            using SD = SpringDashpot;
            constexpr auto wb = NormalForce::walton_braun, sd = NormalForce::spring_dashpot;
            compare<WB, IncrementalSlip>(wb, TangentialLaw::incremental_slip, kinds);
            compare<WB, LinearSpring>(wb, TangentialLaw::linear_spring, kinds);
            compare<WB, Frictionless>(wb, TangentialLaw::none, kinds);
            constexpr auto ws = NormalForce::walton_braun_speed;
            compare<WS, IncrementalSlip>(ws, TangentialLaw::incremental_slip, kinds);
            compare<WS, LinearSpring>(ws, TangentialLaw::linear_spring, kinds);
            compare<WS, Frictionless>(ws, TangentialLaw::none, kinds);
            using WC = WaltonBraunCorrected;
            constexpr auto wc = NormalForce::walton_braun_corrected;
            compare<WC, IncrementalSlip>(wc, TangentialLaw::incremental_slip, kinds);
            compare<WC, LinearSpring>(wc, TangentialLaw::linear_spring, kinds);
            compare<WC, Frictionless>(wc, TangentialLaw::none, kinds);
            using WT = WaltonBraunTable;
            constexpr auto wt = NormalForce::walton_braun_table;
            compare<WT, IncrementalSlip>(wt, TangentialLaw::incremental_slip, kinds);
            compare<WT, LinearSpring>(wt, TangentialLaw::linear_spring, kinds);
            compare<WT, Frictionless>(wt, TangentialLaw::none, kinds);
            compare<Hertz, Mindlin>(NormalForce::hertz, TangentialLaw::mindlin, kinds);
            compare<Hertz, Frictionless>(NormalForce::hertz, TangentialLaw::none, kinds);
            compare<SD, IncrementalSlip>(sd, TangentialLaw::incremental_slip, kinds);
            compare<SD, LinearSpring>(sd, TangentialLaw::linear_spring, kinds);
            compare<SD, Frictionless>(sd, TangentialLaw::none, kinds);
        });
    }
}

// In a contact that does not turn, rounding must not change the force step after step.
TEST(VectorLaws, AContactAtRestKeepsItsForceInSinglePrecision) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> one(-1, 1);
    for (int contact = 0; contact < 40; ++contact) {
        const Vec3 k = Vec3(one(random), one(random), one(random)).normalized();
        const Vec3 t = k.cross(Vec3(one(random), one(random), one(random)));
        using Lane = OneLane<float, true>;
        const auto rounded = [](const Vec3& v) { return Triple<Lane>{v.x(), v.y(), v.z()}; };
        const Triple<Lane> normal = rounded(k), before = rounded(t);
        const Triple<Lane> none{Lane(0), Lane(0), Lane(0)};
        Triple<Lane> force = before;
        for (int step = 0; step < 100000; ++step) force = carry_along(force, none, normal);
        const float off = (force - before).squared().value;
        EXPECT_LT(off, 1e-10f * before.squared().value) << "contact " << contact;
    }
}

// The softness y of a step solves y^(1/gamma) + b y = a: exactly for gamma 1 and 2, after two steps of
// Newton's method for 1/3, after one for others. Their error grows with the share c of the room that the step
// takes.
TEST(VectorLaws, SoftnessSolvesItsEquation) {
    const auto bound = [](double gamma, double c) {
        if (gamma == 1 || gamma == 2) return 1e-12;
        if (gamma == 1.0 / 3.0) return std::min(0.05, 1e-14 + c * c * c);
        return std::min(0.5, 1e-14 + c * c);
    };
    for (const double gamma : {1.0 / 3.0, 0.6, 1.0, 1.7, 2.0}) {
        for (const double a : {1e-9, 1e-6, 0.01, 0.3, 0.7, 0.99, 1.0, 3.0}) {
            for (const double b : {0.0, 1e-9, 1e-4, 0.01, 0.1, 1.0, 3.0, 10.0, 1e6}) {
                if (a > 1 + b) continue;
                double low = 0, high = 1;
                for (int k = 0; k < 200; ++k) {
                    const double middle = 0.5 * (low + high);
                    (std::pow(middle, 1 / gamma) + b * middle > a ? high : low) = middle;
                }
                const double y = softness(a, b, gamma), c = b * std::pow(a, gamma - 1);
                EXPECT_NEAR(y, low, bound(gamma, c) * low) << gamma << " " << a << " " << b;
                EXPECT_GT(y, gamma <= 1 ? low * (1 - 1e-12) : 0) << gamma << " " << a << " " << b;
                const float rounded =
                    softness(static_cast<float>(a), static_cast<float>(b), static_cast<float>(gamma));
                EXPECT_NEAR(rounded, y, (c > 0.1 ? 1e-3 : 3e-6) * y) << gamma << " " << a << " " << b;
            }
        }
    }
}

// A tumbling heap of two sizes in a corner with a round wall, which has every kind of contact.
std::vector<double> tumble(TangentialLaw tangential, int threads, double skin = 0.0002,
                           Precision precision = Precision::full, int steps = 300) {
    HandMadeBed w = make_world(walton_braun_pair(0.8, 0.4), 2e-6, NormalForce::walton_braun, tangential);
    w.plan.grain[0].model.precision = w.plan.wall[0].model.precision = precision;
    w.team = std::make_unique<Team>(threads);
    Face round;
    round.kind = Face::Kind::cylinder;
    round.radius = 0.02;
    Face slant = floor_face();
    slant.normal = Vec3(0.3, 0.1, 1).normalized();
    w.around.faces = {floor_face(), round, slant};
    w.around.gravity = {0, 0, -9.81};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> one(-1, 1);
    for (int k = 0; k < 300; ++k) {
        const double r = k % 7 == 0 ? 0.0016 : 0.0008;
        w.grains.add(k, 0, Vec3(0.01 * one(random), 0.01 * one(random), 0.012 + 0.008 * one(random)), r,
                     kDensity);
        w.grains.motion.back().velocity = 0.3 * Vec3(one(random), one(random), one(random));
        w.grains.motion.back().spin = 100 * Vec3(one(random), one(random), one(random));
    }
    w.around.skin = skin;
    w.start();
    w.run(steps);
    std::vector<double> state;
    for (int k = 0; k < 300; ++k) {
        const Vec3 &x = w.position(k), &v = w.velocity(k), &s = w.spin(k);
        state.insert(state.end(), {x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), s.x(), s.y(), s.z()});
    }
    return state;
}

// All widths that fuse multiplications with additions give the same bits, and so do all that do not.
TEST(VectorSteps, GiveTheSameBitsAtEveryWidthAndNumberOfThreads) {
    for (const auto law :
         {TangentialLaw::incremental_slip, TangentialLaw::linear_spring, TangentialLaw::none}) {
        for (const auto precision : {Precision::full, Precision::mixed}) {
            std::vector<double> expected[2];
            for_each_width([&] {
                for (const int threads : {1, 3}) {
                    const std::vector<double> state = tumble(law, threads, 0.0001, precision, 150);
                    if (expected[fuses()].empty()) expected[fuses()] = state;
                    EXPECT_EQ(state, expected[fuses()]) << "on " << threads;
                }
            });
        }
        EXPECT_NE(tumble(law, 1, 0.0001, Precision::full, 150),
                  tumble(law, 1, 0.0001, Precision::mixed, 150));
    }
    EXPECT_EQ(tumble(TangentialLaw::none, 5), tumble(TangentialLaw::none, 1));
}

// Lists are renewed every few steps or once in the run. Histories are carried over, and turned where two
// grains changed places, and no contact is missed. Only the order of sums differs, and with it the rounding.
TEST(Lists, DoNotShowInTheMotion) {
    for (const auto law : {TangentialLaw::incremental_slip, TangentialLaw::linear_spring}) {
        const std::vector<double> often = tumble(law, 1, 0.00002), seldom = tumble(law, 2, 0.002);
        double largest = 0;
        for (std::size_t k = 0; k < often.size(); ++k)
            largest = std::max(largest, std::abs(often[k] - seldom[k]) / (1e-3 + std::abs(seldom[k])));
        EXPECT_LT(largest, 1e-6);
        EXPECT_GT(largest, 0) << "the two should sum in different orders";
    }
}

}  // namespace
}  // namespace grainreel
