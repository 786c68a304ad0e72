// Tests of moments of a run that are restored from its checkpoints.
#include "engine/run/replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool go_on(double) {
    return true;
}

// The run of a scene with checkpoints in its folder, and the scene and the plan as they are read there.
struct RunOnDisk {
    RunOnDisk(const fs::path& folder, std::vector<std::string> sets, int threads) : here(folder) {
        sets.insert(sets.end(), {"start.settle_limit=0.02 s", "run.duration=0.15 s"});
        const Scene asked =
            read_scene_text(test::small_scene_text, "fifty.toml", with_tested_precision(sets), measurable_in);
        const Plan chosen = make_plan(asked);
        run.emplace(asked, chosen, threads);
        run->pack();
        std::ofstream(here / "scene.toml") << resolved_scene(asked, chosen);
        scene = read_scene(here / "scene.toml", {}, measurable_in);
        last = chosen.steps;
        plan = chosen;
    }
    // Runs to the end in steps that no replay will take, and calls `see` at each of these rising steps.
    template <class See>
    void go(const std::vector<std::int64_t>& steps, const See& see) {
        CheckpointRing ring(here, 64'000'000, 0, last);
        ring.add(0, [&](const fs::path& file) { run->save_checkpoint(file); });
        for (const std::int64_t step : steps) {
            run->advance(step);
            see(step);
            if (ring.due(step)) ring.add(step, [&](const fs::path& file) { run->save_checkpoint(file); });
        }
    }
    SimulatedBed at(std::int64_t step, int threads) const {
        return replayed(here, kept_checkpoints(here), step, threads, go_on);
    }

    fs::path here;
    Scene scene;
    Plan plan;
    std::optional<SimulatedBed> run;
    std::int64_t last = 0;
};

std::vector<std::int64_t> random_steps(std::size_t count, std::int64_t last) {
    Random random(7, Stream::centres);
    std::vector<std::int64_t> steps;
    for (std::size_t i = 0; i < count; ++i)
        steps.push_back(1 + static_cast<std::int64_t>(random.uniform() * static_cast<double>(last - 1)));
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

// The run has every instrument, one of which looks at each step; the replay goes without them.
TEST(Replay, AMomentHasTheStateThatTheRunHadThere) {
    const test::TemporaryFolder here;
    RunOnDisk run(here.path(), {"output.instruments=[\"energy_balance\", \"walls\", \"surface\", \"bed\"]"},
                  2);
    const std::vector<std::int64_t> steps = random_steps(100, run.last);
    std::map<std::int64_t, std::uint64_t> hash;
    run.go(steps, [&](std::int64_t step) { hash[step] = run.run->state_hash(); });
    EXPECT_GT(kept_checkpoints(here.path()).size(), 10u);
    for (const int threads : {1, 2, 3})
        for (const std::int64_t step : steps)
            EXPECT_EQ(run.at(step, threads).state_hash(), hash[step]) << step << ' ' << threads;
}

class ReplayWith : public testing::TestWithParam<const char*> {};

// The run stops at other steps than the replay, and at every step for the energy balance.
TEST_P(ReplayWith, StopsOnTheWayDecideNothing) {
    const test::TemporaryFolder here;
    RunOnDisk run(here.path(), {GetParam(), "output.instruments=[\"energy_balance\"]", "run.duration=0.06 s"},
                  1);
    const std::vector<std::int64_t> steps = random_steps(20, run.last);
    std::map<std::int64_t, std::uint64_t> hash;
    run.go(steps, [&](std::int64_t step) { hash[step] = run.run->state_hash(); });
    for (const auto& one : kept_checkpoints(here.path()))
        if (one.step > 0) fs::remove(one.file);
    for (const std::int64_t step : {steps[3], steps[11], steps.back()})
        EXPECT_EQ(run.at(step, 1).state_hash(), hash[step]) << step;
}

INSTANTIATE_TEST_SUITE_P(Integrators, ReplayWith,
                         testing::Values("run.integrator=velocity-verlet", "run.integrator=leapfrog",
                                         "run.integrator=position-verlet", "run.integrator=forest-ruth",
                                         "run.integrator=gear", "run.precision=mixed"),
                         [](const auto& of) {
                             std::string name = of.param;
                             name = name.substr(name.find('=') + 1);
                             name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                             return name;
                         });

// Newton's second law for a thousand grains: the contacts in a snapshot move them as the next step does.
// Velocity Verlet: x' = x + dt v + dt^2 a / 2.
void expect_contacts_move_grains(const std::vector<std::string>& sets) {
    const test::TemporaryFolder here;
    RunOnDisk run(here.path(), sets, 1);
    std::size_t pushed = 0, seen = 0;
    run.go(random_steps(20, run.last), [](std::int64_t) {});
    const double dt = run.plan.clock.step;
    for (const std::int64_t step : random_steps(21, run.last)) {
        SimulatedBed moment = run.at(step, 1);
        const State now = moment.frame();
        std::vector<Vec3> force(now.size(), Vec3(0, 0, 0));
        for (const DetailedContact& one : moment.contact_forces()) {
            force[static_cast<std::size_t>(one.first)] += one.on_first();
            if (one.second >= 0) force[static_cast<std::size_t>(one.second)] += one.on_second();
        }
        moment.advance(step + 1);
        const State later = moment.frame();
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double mass = run.scene.species[now.species[i]].density * 4.0 / 3 * std::numbers::pi *
                                std::pow(now.radius[i], 3);
            const Vec3 sum = force[i] + mass * run.scene.gravity;
            const Vec3 way = later.position[i] - now.position[i] - dt * now.velocity[i];
            const double scale = std::max(force[i].norm(), mass * 9.81);
            EXPECT_LT((sum - mass * 2 * way / (dt * dt)).norm(), 1e-6 * scale) << step << ' ' << i;
            pushed += force[i].norm() > 0;
            ++seen;
        }
    }
    EXPECT_GE(seen, 1000u);
    EXPECT_GT(pushed, seen / 4);
}

TEST(ReplayedForces, AddUpToMassTimesAcceleration) {
    expect_contacts_move_grains({"run.contact_corrections=false", "run.precision=double"});
}
TEST(Replay, ADamagedCheckpointIsPassedOver) {
    const test::TemporaryFolder here;
    RunOnDisk run(here.path(), {"run.duration=0.05 s"}, 1);
    const std::vector<std::int64_t> steps = random_steps(20, run.last);
    run.go(steps, [](std::int64_t) {});
    const std::uint64_t hash = run.run->state_hash();
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(here.path());
    for (std::size_t k = 1; k < kept.size(); ++k) {
        std::fstream file(kept[k].file, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(kept[k].bytes - 9));
        file.put('\x55').put('\x55');
    }
    EXPECT_EQ(run.at(steps.back(), 1).state_hash(), hash);
    for (const KeptCheckpoint& one : kept) fs::resize_file(one.file, 100);
    EXPECT_THROW(run.at(steps.back(), 1), UserError);
    fs::remove_all(here / "checkpoints");
    try {
        run.at(steps.back(), 1);
        ADD_FAILURE() << "there is no checkpoint";
    } catch (const UserError& mistake) {
        EXPECT_THAT(mistake.what(), HasSubstr("has no checkpoint of"));
    }
}

// Checkpoints hold the scene as it was used, so changes of scene.toml do not matter.
TEST(Replay, NeedsNoScene) {
    const test::TemporaryFolder here;
    RunOnDisk run(here.path(), {"run.duration=0.05 s"}, 1);
    std::uint64_t hash = 0;
    run.go({10, 20}, [&](std::int64_t) { hash = run.run->state_hash(); });
    fs::remove(here / "scene.toml");
    EXPECT_EQ(run.at(20, 1).state_hash(), hash);
}

// Bytes that are no real checkpoints: the ring looks only at sizes.
struct Written {
    std::uintmax_t bytes;
    void operator()(const fs::path& file) const { std::ofstream(file) << std::string(bytes, 'x'); }
};

TEST(CheckpointRing, CoversARunOfUnknownLengthEvenly) {
    const test::TemporaryFolder here;
    constexpr std::int64_t last = 100'000;
    CheckpointRing ring(here.path(), 1'000'000, 0, 10);  // as if the run had been planned to be short
    Random random(3, Stream::centres);
    for (std::int64_t step = 0; step < last; step += 1 + static_cast<std::int64_t>(300 * random.uniform()))
        if (ring.due(step)) ring.add(step, Written{100});
    const std::vector<KeptCheckpoint>& kept = ring.kept();
    ASSERT_EQ(kept.size(), CheckpointRing::kMost);
    EXPECT_EQ(kept.front().step, 0);
    std::int64_t gap = last - kept.back().step;
    for (std::size_t k = 1; k < kept.size(); ++k) gap = std::max(gap, kept[k].step - kept[k - 1].step);
    EXPECT_LT(gap, 2.5 * last / CheckpointRing::kMost);
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(here / "checkpoints")) files += entry.is_regular_file();
    EXPECT_EQ(files, kept.size());
}

TEST(CheckpointRing, StaysWithinItsBytesAndKeepsTheFirst) {
    const test::TemporaryFolder here;
    CheckpointRing ring(here.path(), 1000, 0, 100);
    for (std::int64_t step = 0; step <= 100; ++step)
        if (ring.due(step)) ring.add(step, Written{150});
    std::uintmax_t bytes = 0;
    for (const KeptCheckpoint& one : ring.kept()) bytes += fs::file_size(one.file);
    EXPECT_LE(bytes, 1000u);
    EXPECT_GE(ring.kept().size(), 5u);
    EXPECT_EQ(ring.kept().front().step, 0);
    // A checkpoint that is larger than all may be together is not kept, and not tried again.
    const test::TemporaryFolder there;
    CheckpointRing small(there.path(), 100, 0, 100);
    small.add(0, Written{150});
    EXPECT_TRUE(small.kept().empty());
    EXPECT_FALSE(small.due(50));
    EXPECT_TRUE(fs::is_empty(there / "checkpoints"));
}

TEST(CheckpointRing, TakesOverWhatLiesThereAndForgetsTheFuture) {
    const test::TemporaryFolder here;
    {
        CheckpointRing ring(here.path(), 1000, 0, 100);
        for (const std::int64_t step : {0, 20, 40, 60}) ring.add(step, Written{10});
    }
    std::ofstream(here / "checkpoints/notes.txt") << "not ours";
    const CheckpointRing ring(here.path(), 1000, 40, 200);
    ASSERT_EQ(ring.kept().size(), 3u);
    EXPECT_EQ(ring.kept().back().step, 40);
    EXPECT_FALSE(fs::exists(here / "checkpoints/000000000060.grs"));
    EXPECT_TRUE(fs::exists(here / "checkpoints/notes.txt"));
}

}  // namespace
}  // namespace grainreel
