// A run of another engine goes on from its restart file, as if it had not been broken off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/handover/deck_dump.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/handover_folder.hpp"
#include "tests/engines/handed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

std::string turning_box(double restitution, double friction) {
    return balls_in_box(restitution, friction, R"(
turn = { axis = [1, 0, 0], through = [0, 0, 0.012], rate = "60 rpm" }
[output]
trajectory_interval = "10 ms"
[run]
duration = "0.2 s"
step = 4e-5
)");
}

class EngineGoesOn : public testing::TestWithParam<PeerEngine> {
  protected:
    void SetUp() override { NEEDS_ENGINE(GetParam()); }

    // m, the farthest that a grain is, 250 steps after the restart, from where it was in one go.
    double farthest(double restitution, double friction) {
        const PeerEngine engine = GetParam();
        const TemporaryFolder folder;
        CarryRequest request;
        request.engine = engine;
        hand_over(turning_box(restitution, friction), request, folder.path());
        EXPECT_EQ(run_engine(PeerProcess(engine, 1, deck_name(engine)), folder.path()), "");
        const auto whole = frames_of(engine, folder.path());
        EXPECT_EQ(newest_restart(folder.path(), engine), 5000);

        trim_dump(folder / dump_name(engine), 3000);
        EXPECT_EQ(frames_of(engine, folder.path()).rbegin()->first, 3000);
        const std::string restart = fmt::format("{}.3000", restart_name(engine));
        EXPECT_EQ(run_engine(PeerProcess(engine, 1, deck_name(engine), restart), folder.path()), "");
        const auto again = frames_of(engine, folder.path());
        EXPECT_EQ(again.size(), whole.size());
        const State &then = whole.at(3250), &now = again.at(3250);
        EXPECT_EQ(then.size(), 60u);
        double most = 0;
        for (std::size_t i = 0; i < then.size(); ++i)
            most = std::max(most, (then.position[i] - now.position[i]).norm());
        return most;
    }
};

// Forces that depend on places alone are the same again: grains, walls and the turn are where they were.
TEST_P(EngineGoesOn, WithTheSameBitsWhereNothingIsLost) {
    EXPECT_LT(farthest(1, 0), 1e-12);
}

// LAMMPS keeps the histories of all contacts. LIGGGHTS keeps those between grains and forgets those with
// walls.
TEST_P(EngineGoesOn, WithTheHistoriesOfItsContacts) {
    EXPECT_LT(farthest(1, 0.5), GetParam() == PeerEngine::lammps ? 1e-12 : 5e-5);
}

// Within a step both take the velocity in its middle for dashpots, and at a restart that of a whole step. A
// wall that had not turned would be millimetres off.
TEST_P(EngineGoesOn, NearlyWithDashpots) {
    EXPECT_LT(farthest(0.7, 0.5), 5e-5);
}

INSTANTIATE_TEST_SUITE_P(Both, EngineGoesOn, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

}  // namespace
}  // namespace grainreel::test
