// Tests that a card, emulated, gives every bit of the processor's steps: grains, loads, work, lists and
// histories.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "engine/card/card_bed.hpp"
#include "engine/card/refusal.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "tests/instruction_sets.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// All that steps may change, as bytes.
std::string bits_of(const Grains& grains, const StepLoop& loop) {
    std::ostringstream out;
    const auto put = [&](const auto& values) {
        out.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(values[0])));
    };
    put(grains.id), put(grains.place), put(grains.motion), put(grains.load), put(grains.wall_work);
    loop.save(out);
    return out.str();
}

struct Steps {
    int steps = 250, pieces = 1;
    double drag = 0;
};

struct Outcome {
    std::string bits;
    std::int64_t refreshes = 0, rebuilds = 0;
    std::size_t contacts = 0;  // at the ends of all pieces
    bool finite = true;
};

Outcome run_bed(BenchBed bed, const Steps& run, bool on_card) {
    Team team(1);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    if (on_card) loop.use(std::make_unique<card::CardBed>(card::emulated_device()));
    loop.restart();
    const int each = run.steps / run.pieces;
    std::size_t contacts = 0;
    for (int k = 0; k < run.pieces; ++k) {
        loop.run(k * each, each, bed.plan.clock.step, run.drag);
        loop.visit_contacts((k + 1) * each, [&](const ContactView&) { ++contacts; });
    }
    Outcome done{bits_of(bed.grains, loop), loop.refreshes(), loop.rebuilds(), contacts};
    for (const Motion& m : bed.grains.motion) done.finite &= m.velocity.allFinite();
    return done;
}

// Calls work() with kernels that round a product and a sum once, if this processor has any.
template <class Work>
void where_fused(const Work& work) {
    for (const std::int64_t set : test::fused_sets)
        if (test::has_instruction_set(set)) return test::with_instruction_set(set, work);
    GTEST_SKIP() << "no fused multiply-add here";
}

BenchBed bed_of(const std::string& name, int grains, int fall) {
    const auto& all = bench_cases();
    BenchBed bed =
        std::find_if(all.begin(), all.end(), [&](const BenchCase& c) { return c.name == name; })->bed(grains);
    for (auto* kinds : {&bed.plan.grain, &bed.plan.wall})
        for (PairPlan& pair : *kinds) pair.model.precision = Precision::full;
    Team team(1);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    loop.restart();
    loop.run(-fall, fall, bed.plan.clock.step, 0);
    return bed;
}

struct Golden {
    const char* name;
    int grains, fall;
};
class CardBits : public testing::TestWithParam<Golden> {};

// The scenes of golden_test.cpp, at the moments that are compared there.
TEST_P(CardBits, AreThoseOfTheProcessor) {
    where_fused([&] {
        const BenchBed bed = bed_of(GetParam().name, GetParam().grains, GetParam().fall);
        ASSERT_EQ(card::what_a_card_refuses(bed.plan, bed.around), "");
        for (const int pieces : {1, 5}) {
            const Steps run{.steps = 250, .pieces = pieces};
            const Outcome here = run_bed(bed, run, false), there = run_bed(bed, run, true);
            EXPECT_EQ(here.bits == there.bits, true) << pieces << " pieces";
            EXPECT_EQ(here.refreshes, there.refreshes);
            EXPECT_EQ(here.rebuilds, there.rebuilds);
            EXPECT_GT(here.contacts, 0u);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Cases, CardBits,
                         testing::Values(Golden{"bed10k", 400, 40000},
                                         Golden{"bed10k-walton-braun", 400, 40000},
                                         Golden{"frictionless", 400, 40000}, Golden{"wedge", 405, 40000},
                                         Golden{"intruder", 1000, 25000}, Golden{"gas", 400, 12000}),
                         [](const auto& one) {
                             std::string name = one.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// A random bed: laws, sizes, walls, motion and scheme.
class RandomBed {
  public:
    explicit RandomBed(unsigned seed) : random_(seed) {}

    BenchBed bed() {
        BenchBed bed;
        choose_laws(bed.plan);
        bed.plan.clock.step = 2e-6;
        bed.plan.arms = is(0.7) ? LeverArms::contact_plane : bed.plan.arms;
        constexpr Integrator kSchemes[] = {Integrator::velocity_verlet, Integrator::leapfrog,
                                           Integrator::position_verlet, Integrator::forest_ruth};
        bed.plan.integrator = is(0.6) ? kSchemes[0] : kSchemes[number(4)];
        choose_walls(bed);
        add_grains(bed.grains);
        return bed;
    }
    Steps run() { return {.steps = 2000, .pieces = 5 + number(10), .drag = is(0.3) ? 40.0 : 0.0}; }

  private:
    int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    bool is(double share) { return any(0, 1) < share; }
    Vec3 vector(double size) {
        const double x = any(-size, size), y = any(-size, size);
        return {x, y, any(-size, size)};
    }

    PairPlan pair(const ContactModel& model) {
        PairPlan p = walton_braun_pair(any(0.5, 0.9), is(0.1) ? 0 : any(0.1, 0.6));
        for (double* stiffness : {&p.loading_stiffness, &p.unloading_stiffness, &p.tangential_stiffness})
            *stiffness *= 0.2;
        constexpr double kPowers[] = {1.0 / 3, 1, 2};
        p.gamma = kPowers[number(3)];
        p.model = model;
        p.rolling_friction = model.rolls ? any(0.02, 0.2) : 0;
        p.attraction = is(0.2);
        p.hardening = model.normal == NormalForce::walton_braun_speed ? 2e4 : 0;
        if (model.normal == NormalForce::walton_braun_table)
            p.restitution_table = {{0.1, 0.9}, {0.4, 0.7}, {2, 0.4}};
        if (model.normal == NormalForce::walton_braun_speed) p.unloading_stiffness = p.loading_stiffness;
        p.normal_damping = 8e3;
        p.tangential_damping = 3e3;
        p.modulus = 4e7;
        p.hertz_damping = 0.3;
        if (model.normal == NormalForce::hertz) p.tangential_ratio = 0.82;
        return p;
    }
    ContactModel model() {
        constexpr NormalForce kNormal[] = {
            NormalForce::walton_braun,       NormalForce::walton_braun_corrected,
            NormalForce::walton_braun_speed, NormalForce::walton_braun_table,
            NormalForce::spring_dashpot,     NormalForce::hertz};
        constexpr TangentialLaw kTangential[] = {TangentialLaw::incremental_slip,
                                                 TangentialLaw::linear_spring, TangentialLaw::none};
        ContactModel m{};
        m.normal = kNormal[number(6)];
        m.tangential = kTangential[number(3)];
        if (m.normal == NormalForce::hertz && m.tangential != TangentialLaw::none)
            m.tangential = TangentialLaw::mindlin;
        m.rolls = m.tangential != TangentialLaw::none && is(0.3);
        m.precision = Precision::full;
        return m;
    }
    // One or two species; pairs of species may follow laws of their own, and so may walls.
    void choose_laws(Plan& plan) {
        species_ = 1 + number(2);
        const ContactModel of_all = model(), of_mixed = is(0.5) ? of_all : model();
        const ContactModel of_walls = is(0.5) ? of_all : model();
        plan.grain.clear(), plan.wall.clear();
        if (species_ == 1) {
            plan.grain = {pair(of_all)};
        } else {
            const PairPlan mixed = pair(of_mixed);
            plan.grain = {pair(of_all), mixed, mixed, pair(of_all)};
        }
        for (int s = 0; s < species_; ++s) plan.wall.push_back(pair(of_walls));
    }
    void choose_walls(BenchBed& bed) {
        Container c;
        constexpr Container::Shape kShapes[] = {Container::Shape::box, Container::Shape::cylinder,
                                                Container::Shape::wedge};
        c.shape = kShapes[number(3)];
        c.depth = 0.016;
        c.half_width = c.shape == Container::Shape::cylinder ? 0.009 : 0.008;
        c.half_angle = 0.4;
        c.slant_height = 0.008;
        c.height = 0.03;
        Drive drive;
        drive.present = is(0.7);
        drive.frequency = any(20, 200);
        drive.amplitude = any(0.1e-3, 1e-3);
        drive.direction = is(0.5) ? Vec3(0, 0, 1) : Vec3(0.6, 0, 0.8);
        drive.ramp = 0;
        bed.around.faces = container_faces(c, drive);
        bed.around.gravity = Vec3(0, 0, is(0.2) ? 0 : any(-2000, -300));
        bed.around.motion = DriveMotion(drive, bed.plan.clock);
        bed.around.skin = any(0.1e-3, 0.5e-3);
        if (c.shape == Container::Shape::box && is(0.4)) {
            std::erase_if(bed.around.faces, [](const Face& face) { return std::abs(face.normal.x()) > 0.5; });
            bed.around.period = 0.016;
        }
    }
    // A loose lattice that is thrown down, with a large grain in it now and then.
    void add_grains(Grains& grains) {
        const double small = any(0.7e-3, 1.4e-3);
        const Vec3 thrown(any(-0.3, 0.3), any(-0.3, 0.3), any(-1.5, -0.8));
        for (int n = 0; n < 54; ++n) {
            const int kind = n % species_;
            const double radius = kind == 0 ? any(0.9, 1) * small : n % 18 == 1 ? 1.9e-3 : 0.5 * small;
            const Vec3 place(0.0042 * (n % 3 - 1), 0.0042 * (n / 3 % 3 - 1), 0.0062 + 0.0036 * (n / 9));
            grains.add(n, kind, place + vector(0.1e-3), radius, kDensity);
            grains.motion.back().velocity = thrown + vector(0.5);
            grains.motion.back().spin = vector(100);
        }
    }

    std::mt19937 random_;
    int species_ = 1;
};

TEST(CardRandomBeds, HaveTheBitsOfTheProcessor) {
    where_fused([&] {
        std::size_t contacts = 0;
        std::int64_t refreshes = 0;
        for (unsigned seed = 1; seed <= 50; ++seed) {
            RandomBed random(seed);
            const BenchBed bed = random.bed();
            const Steps run = random.run();
            ASSERT_EQ(card::what_a_card_refuses(bed.plan, bed.around), "") << seed;
            const Outcome here = run_bed(bed, run, false), there = run_bed(bed, run, true);
            ASSERT_TRUE(here.finite) << "bed " << seed;
            EXPECT_EQ(here.bits == there.bits, true) << "bed " << seed;
            contacts += here.contacts, refreshes += here.refreshes;
        }
        EXPECT_GT(contacts, 500u);
        EXPECT_GT(refreshes, 50);
    });
}

}  // namespace
}  // namespace grainreel
