// The dump of a deck while it grows, and grains that are missing in it.
#include "engine/handover/dump_tail.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string frame_text(std::int64_t step, const std::vector<int>& ids) {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
        "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz \n",
        step, ids.size());
    for (const int id : ids) text += fmt::format("{} 1 0.002 {}e-3 0.5 -1.25e-2 1 2 3 4 5 6\n", id, id);
    return text;
}

class DumpTails : public testing::Test {
  protected:
    void add(const std::string& text) { std::ofstream(file_, std::ios::app) << text; }
    std::string said() {
        try {
            tail_.next();
        } catch (const UserError& wrong) {
            return wrong.what();
        }
        return "";
    }

    const TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_.path() / "x.dump";
    DumpTail tail_{file_};
};

TEST_F(DumpTails, FramesComeOnceTheyAreWhole) {
    EXPECT_FALSE(tail_.next());  // no file yet
    const std::string first = frame_text(0, {3, 1, 2}), second = frame_text(100, {1, 2, 3});
    const std::string all = first + second;
    for (std::size_t k = 0; k < all.size(); ++k) {
        add(all.substr(k, 1));
        const std::optional<DumpRows> rows = tail_.next();
        ASSERT_EQ(rows.has_value(), k + 1 == first.size() || k + 1 == all.size()) << k;
        if (!rows) continue;
        EXPECT_EQ(rows->step, k + 1 == first.size() ? 0 : 100);
        EXPECT_THAT(rows->id, ElementsAre(1, 2, 3));
        EXPECT_EQ(rows->position[2], Vec3(3e-3, 0.5, -1.25e-2));
        EXPECT_EQ(rows->velocity[0], Vec3(1, 2, 3));
        EXPECT_EQ(rows->spin[0], Vec3(4, 5, 6));
    }
}

TEST_F(DumpTails, SaysTheLineOfWhatIsWrong) {
    std::string bad = frame_text(0, {1, 2});
    bad.replace(bad.find("2 1 0.002"), 9, "2 1 nan  ");
    add(frame_text(0, {1, 2}) + bad);
    EXPECT_EQ(said(), "");
    EXPECT_THAT(said(), tells({"x.dump:22", "no row", "twelve"}));
}

TEST_F(DumpTails, OtherColumnsAreNotTheDecks) {
    std::string other = frame_text(0, {1});
    other.replace(other.find("radius"), 6, "mass");
    add(other);
    EXPECT_THAT(said(), HasSubstr("x.dump:9: has other columns"));
}

TEST_F(DumpTails, ACountBeyondTheFileIsWaitedFor) {
    add("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n900000000000000000\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 "
        "1\n-1 1\n"
        "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz\n1 1 1 1 1 1 1 1 1 1 1 1\n");
    EXPECT_FALSE(tail_.next());
}

Frame with(std::int64_t step, const std::vector<std::int32_t>& ids, double z) {
    Frame frame;
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
    const Frame before = with(10, {0, 1, 2}, 0.01), now = with(20, {0, 2}, 0.01);
    try {
        count.compare(&before, now);
        FAIL();
    } catch (const RunError& lost) {
        EXPECT_THAT(lost.what(), tells({"x.dump", "step 20", "grain 1", "missing"}));
    }
    EXPECT_THROW(count.compare(nullptr, now), RunError);
    EXPECT_THROW(count.compare(&before, with(20, {0, 1, 2, 7}, 0.01)), RunError);
    EXPECT_EQ(count.compare(&before, with(20, {0, 1, 2}, 0.01)).left.size(), 0U);
}

TEST(GrainCount, AGrainMayLeaveWhereItCanHaveComeToTheExit) {
    const Scene scene = read_scene_text(
        std::string(kBox) + "top = \"open\"\n[container.outlet]\nwidth = \"20 mm\"\nexit_depth = \"20 mm\"\n",
        "box.toml");
    const GrainCount count(scene, "x.dump");
    // In 10 ms it falls by 0.5 mm.
    const Frame low = with(10, {0, 1, 2}, -0.018), high = with(10, {0, 1, 2}, 0.01);
    EXPECT_THAT(count.compare(&low, with(20, {0, 2}, -0.018)).left, ElementsAre(1U));
    EXPECT_THROW(count.compare(&high, with(20, {0, 2}, 0.01)), RunError);
}

}  // namespace
}  // namespace grainreel::test
