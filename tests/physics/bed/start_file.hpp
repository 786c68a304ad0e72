// A small bed that has settled, in a final.csv and a checkpoint.grs, and scenes that start from them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/grain_table.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

inline constexpr double kBedDiameter = 0.004;

inline const std::string kSpecies =
    test::SmallScene().beads(60, "beads", "3.5 mm to 4.5 mm", "2.5 g/cm3").contacts("0.5", "0.5").text();
inline const char* const kBox = R"([container]
shape = "box"
width = "18 mm"
depth = "16 mm"
height = "50 mm"
)";

class StartFile : public testing::Test {
  protected:
    static Scene scene_of(const std::string& more, std::vector<std::string> sets) {
        sets.insert(sets.begin(), {"run.duration=0.05", "run.threads=1"});
        return read_scene_text(kSpecies + more, "bed.toml", with_tested_precision(sets));
    }
    Scene next_of(const std::string& more, const char* file, std::vector<std::string> sets) const {
        sets.insert(sets.end(), {"start.method=file", "start.file=" + (here / file).string()});
        return scene_of(more, sets);
    }

    struct Rest {
        double contacts = 0, height = 0, energy = 0;  // a grain; m; over m g d
    };
    static Rest rest_of(const SimulatedBed& run, const Scene& scene) {
        const double mass = scene.species[0].density * std::numbers::pi / 6 * std::pow(kBedDiameter, 3);
        const double unit = static_cast<double>(run.grains()) * mass * scene.gravity.norm() * kBedDiameter;
        return {run.measure("contact_number"), run.measure("centre_z_m"),
                (run.measure("kinetic_J") + run.measure("rotational_J")) / unit};
    }
    // A bed that has settled and then lain still. It is written into both files.
    Rest settle(const Scene& scene, double still = 0.02) const {
        const Plan plan = make_plan(scene);
        SimulatedBed run(scene, plan, 1);
        run.pack();
        run.advance(std::llround(still / plan.clock.step));
        write_grain_table(here / "final.csv", run.frame());
        run.save_checkpoint(here / "checkpoint.grs");
        return rest_of(run, scene);
    }
    // Runs for `seconds` and checks at every look that the contacts stay within `share` of those before and
    // that nothing moves.
    static void expect_rest(const Scene& scene, const Rest& before, double share, const std::string& what,
                            double seconds = 0.02) {
        const Plan plan = make_plan(scene);
        SimulatedBed run(scene, plan, 1);
        const PackingResult packed = run.pack();
        EXPECT_TRUE(packed.settled) << what;
        constexpr int looks = 20;
        Rest worst{before.contacts, before.height, 0};
        for (int look = 0; look <= looks; ++look) {
            run.advance(std::llround(look * seconds / looks / plan.clock.step));
            const Rest now = rest_of(run, scene);
            if (std::abs(now.contacts - before.contacts) > std::abs(worst.contacts - before.contacts))
                worst.contacts = now.contacts;
            worst.height = std::max(worst.height, now.height);
            worst.energy = std::max(worst.energy, now.energy);
        }
        EXPECT_LT(worst.energy, 1e-3) << what;
        EXPECT_NEAR(worst.contacts, before.contacts, share * before.contacts) << what;
        EXPECT_LT(worst.height, before.height + 1e-3 * kBedDiameter) << what;
    }
    test::TemporaryFolder here;
};

inline const std::vector<std::string> kLaws = {"walton-braun", "spring-dashpot", "hertz"};

inline std::string law(const std::string& name) {
    return "contact.law=" + name;
}

}  // namespace grainreel
