// The dump of a deck while it grows.
#include "engine/handover/deck_dump.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
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

class DeckDumps : public testing::Test {
  protected:
    void add(const std::string& text) { std::ofstream(file_, std::ios::app) << text; }
    std::string said() {
        try {
            dump_.next();
        } catch (const UserError& wrong) {
            return wrong.what();
        }
        return "";
    }

    const TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_.path() / "x.dump";
    DeckDump dump_{file_};
};

TEST_F(DeckDumps, FramesComeOnceTheyAreWhole) {
    EXPECT_FALSE(dump_.next());  // no file yet
    const std::string first = frame_text(0, {3, 1, 2}), second = frame_text(100, {1, 2, 3});
    const std::string all = first + second;
    for (std::size_t k = 0; k < all.size(); ++k) {
        add(all.substr(k, 1));
        const std::optional<State> rows = dump_.next();
        ASSERT_EQ(rows.has_value(), k + 1 == first.size() || k + 1 == all.size()) << k;
        if (!rows) continue;
        EXPECT_EQ(rows->step, k + 1 == first.size() ? 0 : 100);
        EXPECT_THAT(rows->id, ElementsAre(1, 2, 3));
        EXPECT_EQ(rows->position[2], Vec3(3e-3, 0.5, -1.25e-2));
        EXPECT_EQ(rows->velocity[0], Vec3(1, 2, 3));
        EXPECT_EQ(rows->spin[0], Vec3(4, 5, 6));
    }
}

TEST_F(DeckDumps, SaysWhichNumberIsNotFinite) {
    std::string bad = frame_text(10, {1, 2});
    bad.replace(bad.find("1 2 3 4 5 6\n2"), 1, "nan");  // vx of atom 1
    add(frame_text(0, {1, 2}) + bad);
    EXPECT_EQ(said(), "");
    EXPECT_THAT(said(), tells({"x.dump: step 10: atom 1", "nan", "vx", "no finite number"}));
}

TEST_F(DeckDumps, OtherColumnsAreNotTheDecks) {
    std::string other = frame_text(0, {1});
    other.replace(other.find("radius"), 6, "mass");
    add(other);
    EXPECT_THAT(said(), HasSubstr("x.dump: has other columns"));
}

TEST_F(DeckDumps, ACountBeyondTheFileIsWaitedFor) {
    add("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n900000000000000000\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 "
        "1\n-1 1\n"
        "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz\n1 1 1 1 1 1 1 1 1 1 1 1\n");
    EXPECT_FALSE(dump_.next());
}

// A job whose engine went on from a restart file may have cut the dump before.
TEST_F(DeckDumps, AShorterFileIsSeenAndReadAnew) {
    add(frame_text(0, {1}) + frame_text(100, {1}));
    ASSERT_TRUE(dump_.next());
    EXPECT_FALSE(dump_.is_shorter());
    std::filesystem::resize_file(file_, frame_text(0, {1}).size());
    EXPECT_TRUE(dump_.is_shorter());
    ASSERT_TRUE(dump_.next());  // this frame was known already
    EXPECT_THROW(dump_.next(), RunError);
    dump_.read_anew();
    EXPECT_EQ(dump_.next()->step, 0);
    EXPECT_FALSE(dump_.next());
}

TEST_F(DeckDumps, AreTrimmedAfterAStepAndOfAFrameThatIsNotWhole) {
    const std::string first = frame_text(0, {1, 2}), second = frame_text(100, {1, 2}),
                      third = frame_text(200, {1, 2});
    add(first + second + third);
    trim_dump(file_, 150);
    EXPECT_EQ(text_of(file_), first + second);
    add(third.substr(0, third.size() - 1));
    trim_dump(file_, 1000);
    EXPECT_EQ(text_of(file_), first + second);
}

}  // namespace
}  // namespace grainreel::test
