// Grains that come, leave or are missing between frames of another engine.
#include "engine/handover/grain_count.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

State with(std::int64_t step, const std::vector<std::int32_t>& ids, double z) {
    State frame;
    frame.step = step;
    frame.time = 1e-3 * static_cast<double>(step);
    for (const std::int32_t id : ids) {
        frame.id.push_back(id);
        frame.species.push_back(0);
        frame.radius.push_back(2e-3);
        frame.position.emplace_back(0, 0, z);
        frame.velocity.emplace_back(0, 0, 0);
        frame.spin.emplace_back(0, 0, 0);
    }
    return frame;
}

const std::string kBox = SmallScene()
                             .beads(3, "beads", "4 mm", "2.5 g/cm3")
                             .more("[contact]\nrestitution = 0.6\n")
                             .box("40 mm", "30 mm", "50 mm")
                             .text();

TEST(GrainCount, ALostGrainIsNamedWithItsStep) {
    const Scene scene = read_scene_text(kBox, "box.toml");
    const GrainCount count(scene, "x.dump");
    const State before = with(10, {0, 1, 2}, 0.01), now = with(20, {0, 2}, 0.01);
    try {
        count.compare(&before, now);
        FAIL();
    } catch (const RunError& lost) {
        EXPECT_THAT(lost.what(), tells({"x.dump", "step 20", "grain 1", "missing"}));
    }
    EXPECT_THROW(count.compare(nullptr, now), RunError);
    EXPECT_THROW(count.compare(nullptr, with(10, {0, 1, 2, 3}, 0.01)), RunError);
    count.compare(nullptr, before);
    EXPECT_THROW(count.compare(&before, with(20, {0, 1, 2, 7}, 0.01)), RunError);
    EXPECT_EQ(count.compare(&before, with(20, {0, 1, 2}, 0.01)).left.size(), 0U);
}

TEST(GrainCount, AGrainMayLeaveWhereItCanHaveComeToTheExit) {
    const Scene scene = read_scene_text(
        std::string(kBox) + "top = \"open\"\n[container.outlet]\nwidth = \"20 mm\"\nexit_depth = \"20 mm\"\n",
        "box.toml");
    const GrainCount count(scene, "x.dump");
    // In 10 ms it falls by 0.5 mm.
    const State low = with(10, {0, 1, 2}, -0.018), high = with(10, {0, 1, 2}, 0.01);
    EXPECT_THAT(count.compare(&low, with(20, {0, 2}, -0.018)).left, ElementsAre(1U));
    EXPECT_THROW(count.compare(&high, with(20, {0, 2}, 0.01)), RunError);
}

}  // namespace
}  // namespace grainreel::test
