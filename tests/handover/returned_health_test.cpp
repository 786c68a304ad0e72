// Frames of another engine are looked at as states of our own runs: overlaps, walls, speeds, energy.
#include "engine/handover/returned_health.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel::test {
namespace {

using testing::HasSubstr;
using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

constexpr double kRadius = 0.002;  // m

std::string box(const std::string& more = "") {
    return SmallScene()
               .beads(40, "ball")
               .more("[contact]\nlaw = \"spring-dashpot\"\nfriction_law = \"linear-spring\"\n")
               .more("stiffness = 1000\nrestitution = 0.8\nfriction = 0.3\n")
               .box("40 mm", "20 mm", "100 mm")
               .lasts("0.4 s")
               .more("step = 2e-5\n")
               .text() +
           more;
}

class ReturnedHealths : public testing::Test {
  protected:
    void use(const std::string& text) {
        scene_ = read_scene_text(text, "returned.toml");
        plan_ = make_plan(scene_);
        health_ = std::make_unique<ReturnedHealth>(scene_, plan_);
    }
    State frame(std::int64_t step, const std::vector<Vec3>& places,
                const std::vector<Vec3>& velocities = {}) {
        State made;
        made.step = step;
        made.time = plan_.clock.time(step);
        for (std::size_t i = 0; i < places.size(); ++i) {
            made.id.push_back(static_cast<std::int32_t>(i));
            made.species.push_back(0);
            made.radius.push_back(kRadius);
            made.position.push_back(places[i]);
            made.velocity.push_back(velocities.empty() ? Vec3(0, 0, 0) : velocities[i]);
            made.spin.emplace_back(0, 0, 0);
        }
        return made;
    }
    std::string said(const State& frame) {
        try {
            health_->look(frame);
        } catch (const RunError& unsound) {
            return unsound.what();
        }
        return "";
    }

    Scene scene_;
    Plan plan_;
    std::unique_ptr<ReturnedHealth> health_;
};

TEST_F(ReturnedHealths, TellTheLargestOverlapOfAllFrames) {
    use(box("overlap = 0.01\n"));
    health_->look(frame(0, {{0, 0, 0.05}, {2 * kRadius * (1 - 0.1), 0, 0.05}}));  // 0.2 of a radius
    health_->look(frame(50, {{0, 0, 0.05}, {2 * kRadius * (1 - 0.05), 0, 0.05}}));
    EXPECT_EQ(health_->deepest().step, 0);
    EXPECT_THAT(health_->overlap_text(), tells({"grain 0 (ball)", "grain 1", "0.2 of", "contact.stiffness"}));
}

TEST_F(ReturnedHealths, OverlapsAreOverTheSmallerRadius) {
    use(box());
    const double apart = 2 * kRadius * (1 - 0.05);  // 0.1 of a radius
    EXPECT_NEAR(health_->look(frame(0, {{0, 0, 0.05}, {apart, 0, 0.05}})), 0.1, 1e-12);
    use(box());
    EXPECT_NEAR(health_->look(frame(10, {{0, 0, 0.05}, {0, 0, kRadius * (1 - 0.2)}})), 0.2, 1e-12);
}

TEST_F(ReturnedHealths, TheLimitAndTheWordsAreOurs) {
    use(box());
    const double apart = 2 * kRadius * (1 - 0.17);  // 0.34 of a radius; the limit is a third
    EXPECT_THAT(said(frame(50, {{0, 0, 0.05}, {apart, 0, 0.05}})),
                tells({"step 50 (0.001 s)", "grain 0 (ball)", "(0, 0, 0.05) m", "grain 1",
                       "0.34 of the smaller", "contact.stiffness", "run.step"}));
    EXPECT_THAT(said(frame(50, {{0, 0, 0.6 * kRadius}})), tells({"overlaps", "floor", "0.40 of"}));
    EXPECT_THAT(said(frame(50, {{0, 0, -1.1 * kRadius}})), HasSubstr("went through the floor"));
    EXPECT_THAT(said(frame(50, {{0, 0, 0.05}, {0, 0, 0.07}}, {{0, 0, 150}, {0, 0, 0}})),
                tells({"pass each other", "1.5", "in one step"}));
}

// A bed of our own at rest, falling, shaken and after its outlet has opened is sound at each look.
TEST_F(ReturnedHealths, OurOwnRunsAreSound) {
    for (const char* more :
         {"", "[drive]\nfrequency = \"30 Hz\"\ng_level = 5\n",
          "[drive]\nfrequency = \"30 Hz\"\ng_level = 5\ndirection = [1, 1, 0]\n",
          "[container.turn]\naxis = [1, 0, 0]\nthrough = [0, 0, 0.05]\nrate = \"120 rpm\"\n"}) {
        for (const std::int64_t every : {50, 2500}) {
            use(box(more));
            SimulatedBed run(scene_, plan_, 1);
            run.pack();
            for (std::int64_t step = 0; step <= plan_.steps; step += every) {
                run.advance(step);
                EXPECT_EQ(said(run.frame()), "") << more;
            }
        }
    }
}

TEST_F(ReturnedHealths, EnergyThatNoWallGaveIsAnError) {
    // Two meet at 1 m/s each and part at 2 m/s.
    for (const double parting : {1.0, 2.0}) {
        use(box());
        const std::vector<Vec3> before{{-0.003, 0, 0.05}, {0.003, 0, 0.05}};
        EXPECT_EQ(said(frame(0, before, {{1, 0, 0}, {-1, 0, 0}})), "");
        const std::string words = said(frame(50, before, {{-parting, 0, 0}, {parting, 0, 0}}));
        if (parting == 1)
            EXPECT_EQ(words, "");
        else
            EXPECT_THAT(words, tells({"step 50 (0.001 s)", "gained"}));
    }
}

// A floor of 0.3 m/s throws a ball up with (1 + e) 0.3 m/s, but not with 3 m/s.
TEST_F(ReturnedHealths, WallsThatMoveGiveEnergy) {
    for (const double speed : {1.8 * 0.3, 3.0}) {
        use(box("[drive]\nfrequency = \"20 Hz\"\namplitude = \"2.4 mm\"\n"));
        EXPECT_EQ(said(frame(5000, {{0, 0, 0.006}}, {{0, 0, 0}})), "");
        const std::string words = said(frame(5100, {{0, 0, 0.007}}, {{0, 0, speed}}));
        EXPECT_EQ(words.empty(), speed < 1) << words;
    }
}

TEST(NearGrains, AreThoseOfAllPairs) {
    std::mt19937 random(5);
    for (const double period : {0.0, 1.0}) {
        std::uniform_real_distribution<double> along(-0.2, 1.2), size(0.02, 0.1);
        std::vector<Place> places;
        for (int i = 0; i < 400; ++i)
            places.push_back({Vec3(along(random), along(random), along(random)), size(random)});
        places.push_back({Vec3(1e9, 0, 0), 0.01});  // one that has flown away
        Pairs wanted, found;
        for (std::int32_t a = 0; a < 401; ++a)
            for (std::int32_t b = a + 1; b < 401; ++b) {
                Vec3 apart = places[static_cast<std::size_t>(a)].position -
                             places[static_cast<std::size_t>(b)].position;
                if (period > 0) apart.x() = std::remainder(apart.x(), period);
                const double reach =
                    places[static_cast<std::size_t>(a)].radius + places[static_cast<std::size_t>(b)].radius;
                if (apart.norm() < reach) wanted.emplace(a, b);
            }
        for_overlapping(places, period, [&](std::int32_t a, std::int32_t b, double) {
            EXPECT_TRUE(found.emplace(std::min(a, b), std::max(a, b)).second) << a << " " << b;
        });
        EXPECT_GT(wanted.size(), 100u);
        EXPECT_EQ(found, wanted) << period;
    }
}

}  // namespace
}  // namespace grainreel::test
