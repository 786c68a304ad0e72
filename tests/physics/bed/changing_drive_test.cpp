// Tests of a bed under a drive that changes: it gives the same bits on any number of threads and through a
// checkpoint, and measures count its periods.
#include <gtest/gtest.h>

#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

// The drive goes from 20 Hz to 45 Hz over 3 periods, and makes taps from 0.3 s on.
const std::string changing_text = std::string(test::small_scene_text) + R"([[drive.stage]]
from = "50 ms"
frequency = "45 Hz"
g_level = 4
[[drive.stage]]
from = "0.25 s"
kind = "taps"
frequency = "30 Hz"
g_level = 5
interval = "50 ms"
)";

Scene scene_of(std::vector<std::string> sets = {}) {
    sets.insert(sets.begin(), {"contact.stiffness=1500 N/m", "start.settle_limit=0.02 s",
                               "run.duration=0.5 s", "drive.ramp=0"});
    return read_scene_text(changing_text, "changing.toml", with_tested_precision(sets));
}

TEST(ChangingDrive, SameBitsOnAnyThreadsAndThroughACheckpointInAChange) {
    const test::TemporaryFolder folder;
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    const PeriodStretch& change = plan.clock.changes.stretches()[1];
    ASSERT_TRUE(change.changes());
    const auto middle = static_cast<std::int64_t>(change.start + 0.4 * change.length);
    SimulatedBed whole(scene, plan, 1);
    whole.pack();
    whole.advance(middle);
    whole.save_checkpoint(folder / "middle.grs");
    const std::int64_t end = plan.steps;  // after the first taps
    whole.advance(end);
    EXPECT_NEAR(whole.measure("cycles"), plan.clock.cycles(end), 0);
    const Scene next = continued(scene, folder / "middle.grs");
    for (const int threads : {1, 2, 3}) {
        SimulatedBed second(next, plan, threads);
        second.pack();
        ASSERT_EQ(second.step(), middle);
        second.advance(end);
        EXPECT_EQ(second.state_hash(), whole.state_hash()) << threads << " threads";
    }
}

TEST(ChangingDrive, IsPartOfWhatARunGoesOnWith) {
    const Scene scene = scene_of(), other = scene_of({"drive.stage.0.g_level=3"});
    const auto kept = [](const Scene& s) { return scene_to_keep(s, make_plan(s)); };
    const std::vector<KeyDifference> differences = deciding_differences(kept(scene), kept(other));
    ASSERT_FALSE(differences.empty());
    EXPECT_EQ(differences.front().key, "drive.stage[0].amplitude");
}

}  // namespace
}  // namespace grainreel
