// Tests of every number in a row of measures.csv against what frame and contacts say.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/container_faces.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

const std::string kBox = test::SmallScene()
                             .beads(60, "small", "4 mm to 5 mm")
                             .beads(9, "big", "9 mm", "1500")
                             .more("[contact]\nlaw = \"spring-dashpot\"\nrestitution = 0.8\n")
                             .box("30 mm", "30 mm", "90 mm")
                             .shaken("20 Hz", "3")
                             .more("[start]\nsettle_limit = \"0.05 s\"\n")
                             .lasts("1 s")
                             .text();

double sum_of_energies(const Measures& m) {
    return m.at("kinetic_J") + m.at("rotational_J") + m.at("gravitational_J") + m.at("elastic_J");
}

// A box that is shaken up and down, and the work of its walls.
struct Watched {
    explicit Watched(const std::string& friction)
        : scene(read_scene_text(kBox, "box.toml", with_tested_precision({"contact.friction=" + friction}))),
          plan(make_plan(scene)),
          simulation(scene, plan, 1) {
        simulation.pack();
        start = sum_of_energies(simulation.measures());
        power = wall_power();
    }

    // Power (W) that the walls give the grains now: force on each grain times the wall's velocity.
    double wall_power() const {
        const std::vector<Face> faces = container_faces(scene.container, scene.drive);
        const Vec3 velocity = simulation.frame().container().velocity;
        double sum = 0;
        for (const auto& c : simulation.contacts())
            if (c.second < 0) sum += (c.normal * faces[-1 - c.second].normal - c.tangential).dot(velocity);
        return sum;
    }
    void run(std::int64_t steps) {
        for (std::int64_t k = 0; k < steps; ++k) {
            simulation.advance(simulation.step() + 1);
            const double before = power;
            power = wall_power();
            work += 0.5 * (before + power) * plan.clock.step;
        }
    }

    Scene scene;
    Plan plan;
    SimulatedBed simulation;
    double start = 0;            // J
    double power = 0, work = 0;  // W, J
};

// Energy (J) of the linear springs between bodies that overlap, and the largest overlap divided by the
// smaller radius.
std::pair<double, double> springs(const Watched& w, const State& f) {
    const std::size_t kinds = w.scene.species.size();
    double energy = 0, largest = 0;
    const auto add = [&](double overlap, double radius, const PairPlan& pair) {
        if (overlap <= 0) return;
        energy += 0.5 * pair.loading_stiffness * overlap * overlap;
        largest = std::max(largest, overlap / radius);
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            add(f.radius[i] + f.radius[j] - (f.position[i] - f.position[j]).norm(),
                std::min(f.radius[i], f.radius[j]), w.plan.grain[f.species[i] * kinds + f.species[j]]);
        for (const Face& face : container_faces(w.scene.container, w.scene.drive))
            add(f.radius[i] - distance_to(face, f.container().place, f.position[i]).distance, f.radius[i],
                w.plan.wall[f.species[i]]);
    }
    return {energy, largest};
}

Vec3 vector_at(const Measures& m, const std::string& column) {
    return {m.at(column + "_x_m"), m.at(column + "_y_m"), m.at(column + "_z_m")};
}

void expect_grains(const Watched& w, const State& f, const Measures& m) {
    double kinetic = 0, rotational = 0, gravitational = 0, mass = 0;
    Vec3 centre = Vec3::Zero();
    std::vector<Vec3> centres(2, Vec3::Zero());
    std::vector<double> counts(2, 0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        const double r = f.radius[i];
        const double own = w.scene.species[f.species[i]].density * 4 / 3 * std::numbers::pi * r * r * r;
        kinetic += 0.5 * own * f.velocity[i].squaredNorm();
        rotational += 0.5 * 0.4 * own * r * r * f.spin[i].squaredNorm();
        gravitational += own * 9.81 * f.position[i].z();
        mass += own;
        centre += own * f.position[i];
        centres[f.species[i]] += f.position[i];
        counts[f.species[i]] += 1;
    }
    EXPECT_NEAR(m.at("kinetic_J"), kinetic, 1e-9 * kinetic);
    EXPECT_NEAR(m.at("rotational_J"), rotational, 1e-9 * rotational);
    EXPECT_NEAR(m.at("gravitational_J"), gravitational, 1e-9 * gravitational);
    EXPECT_LT((vector_at(m, "centre") - centre / mass).norm(), 1e-12);
    for (std::size_t s = 0; s < 2; ++s) {
        const std::string& name = w.scene.species[s].name;
        EXPECT_LT((vector_at(m, name + "_centre") - centres[s] / counts[s]).norm(), 1e-12) << s;
        EXPECT_NEAR(m.at(name + "_height_m"), centres[s].z() / counts[s] - f.floor().place.z(), 1e-12) << s;
    }
}

void expect_order(const State& f, const Measures& m) {
    std::vector<double> heights;
    for (const Vec3& x : f.position) heights.push_back(x.z() - f.floor().place.z());
    std::vector<double> sorted = heights;
    std::sort(sorted.begin(), sorted.end());
    const double bed = sorted[static_cast<std::size_t>(0.95 * static_cast<double>(f.size() - 1))];
    double above = 0, pairs = 0, in_top = 0, big = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.species[i] != 1) continue;
        big += 1;
        in_top += heights[i] > 0.75 * bed;
        for (std::size_t j = 0; j < f.size(); ++j) {
            if (f.species[j] != 0) continue;
            pairs += 1;
            above += heights[i] > heights[j] ? 1 : 0;
        }
    }
    EXPECT_NEAR(m.at("height_difference"), (m.at("big_height_m") - m.at("small_height_m")) / bed, 1e-12);
    EXPECT_NEAR(m.at("big_above_small"), above / pairs, 1e-12);
    EXPECT_NEAR(m.at("big_in_top_quarter"), in_top / big, 1e-12);
}

TEST(MeasuresOfARun, AreThoseOfFrameAndContacts) {
    for (const char* friction : {"0", "0.5"}) {
        SCOPED_TRACE(friction);
        Watched w(friction);
        w.run(3 * w.plan.clock.steps_per_period / 4);
        const State f = w.simulation.frame();
        const Measures m = w.simulation.measures();
        EXPECT_EQ(m.at("step"), f.step);
        EXPECT_EQ(m.at("time_s"), f.time);
        EXPECT_EQ(m.at("phase_turns"), f.phase);
        EXPECT_EQ(m.at("cycles"), f.cycles);
        EXPECT_NE(f.floor().place.z(), 0);
        EXPECT_EQ(m.at("floor_position_m"), f.floor().place.z());
        expect_grains(w, f, m);
        expect_order(f, m);
        const auto [elastic, largest_overlap] = springs(w, f);
        // With friction the tangential springs add to the energy.
        if (friction == std::string("0"))
            EXPECT_NEAR(m.at("elastic_J"), elastic, 1e-6 * elastic);
        else
            EXPECT_GT(m.at("elastic_J"), elastic);
        EXPECT_NEAR(m.at("largest_overlap"), largest_overlap, 1e-6 * largest_overlap);
        double carrying = 0;
        for (const auto& c : w.simulation.contacts()) carrying += c.second >= 0 ? 2 : 1;
        EXPECT_NEAR(m.at("contact_number"), carrying / static_cast<double>(f.size()), 1e-12);
        EXPECT_GT(std::abs(w.work), 1e-6);
        EXPECT_NEAR(m.at("wall_work_J"), w.work, 1e-3 * std::abs(w.work));
        EXPECT_NEAR(m.at("lost_J"), w.start + m.at("wall_work_J") - sum_of_energies(m),
                    1e-9 * sum_of_energies(m));
        EXPECT_GT(m.at("lost_J"), 0);
    }
}

}  // namespace
}  // namespace grainreel
