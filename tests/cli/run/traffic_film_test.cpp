// Tests of a run that grains leave and enter: its files and its pictures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "engine/base/error.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/start/restart.hpp"
#include "render/film/codec/png.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::TemporaryFolder;

FilmedScene sink_scene(const std::vector<std::string>& more = {}) {
    std::vector<std::string> sets{"output.trajectory_interval=0.01", "film.size=\"480x360\"",
                                  "output.contacts=true",
                                  "container.outlet={width=\"9 mm\", exit_depth=\"6 mm\"}"};
    sets.insert(sets.end(), more.begin(), more.end());
    return read_filmed_scene_text(test::small_scene_text, "sink.toml", sets);
}

// A run in which grains leave through the floor, and two come from above now and then.
struct Sink {
    FilmedScene scene;
    Plan plan = plan_of(scene);
    SimulatedBed simulation;

    explicit Sink(const FilmedScene& of, int threads = 1) : scene(of), simulation(scene, plan, threads) {
        simulation.pack();
    }
    static Plan plan_of(const FilmedScene& scene) {
        Plan plan = make_plan(scene);
        plan.capacity += 20;
        plan.traffic = true;
        return plan;
    }
    void rain(int number) {
        std::vector<ComingGrain> pair;
        for (const double x : {-0.005, 0.005})
            pair.push_back({0, 0.002, scene.species[0].density, Vec3(x, -0.01 + 0.001 * number, 0.036),
                            Vec3(0, 0, -0.2), Vec3(0, 0, 0)});
        simulation.insert(pair);
    }
};

TEST(TrafficFilm, FilesHaveWhoIsThere) {
    const TemporaryFolder here;
    Sink sink(sink_scene());
    RunFiles files(here.path(), sink.scene, sink.plan, sink.simulation, "test", false);
    std::vector<State> frames;
    std::vector<Measures> measures;
    const std::int64_t every = sink.plan.steps / 20;
    for (int i = 0; i < 20; ++i) {
        if (i % 2 == 1) sink.rain(i / 2);
        frames.push_back(sink.simulation.frame());
        measures.push_back(sink.simulation.measures());
        const RunFiles::Contacts contacts = sink.simulation.contacts();
        count_contacts(frames.back(), contacts);
        files.add_frame(frames.back(), contacts);
        files.add_measures(measures.back());
        sink.simulation.advance((i + 1) * every);
    }
    const Traffic& traffic = sink.simulation.traffic();
    EXPECT_EQ(traffic.came, 20);
    ASSERT_GT(traffic.left, 10);
    EXPECT_EQ(sink.simulation.grains(), static_cast<std::size_t>(50 + traffic.came - traffic.left));
    EXPECT_EQ(std::ssize(sink.simulation.take_departures()), traffic.left);
    const TrajectoryReader reader(here / "trajectory.nc");
    ASSERT_EQ(reader.frames(), frames.size());
    std::set<std::int32_t> gone, all;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const State frame = reader.read(i);
        EXPECT_EQ(frame.id, frames[i].id) << i;
        EXPECT_EQ(frame.position, frames[i].position) << i;
        EXPECT_EQ(frame.contact_number, frames[i].contact_number) << i;
        for (const std::int32_t id : frame.id) EXPECT_FALSE(gone.contains(id)) << id << " came back";
        const std::set<std::int32_t> now(frame.id.begin(), frame.id.end());
        all.insert(now.begin(), now.end());
        for (const std::int32_t id : all)
            if (!now.contains(id)) gone.insert(id);
        // Measures count only grains that are there.
        Vec3 small(0, 0, 0);
        double count = 0;
        for (std::size_t k = 0; k < frame.size(); ++k)
            if (frame.species[k] == 0) small += frame.position[k], ++count;
        const Measures& row = measures[i];
        const std::string name = column_part(sink.scene.species[0].name) + "_centre_";
        const Vec3 centre(row.at(name + "x_m"), row.at(name + "y_m"), row.at(name + "z_m"));
        EXPECT_LT((centre - small / count).norm(), 1e-12) << i;
    }
    EXPECT_LE(all.size(), reader.info().capacity);
    // The energy lost, out of all that came in, never falls: no grain gains energy.
    for (std::size_t i = 1; i < measures.size(); ++i)
        EXPECT_GT(measures[i].at("lost_J"),
                  measures[i - 1].at("lost_J") - 1e-3 * measures[i].at("wall_work_J"))
            << i;
}

TEST(TrafficFilm, GoesOnFromItsCheckpoint) {
    const TemporaryFolder here;
    Sink whole(sink_scene());
    const std::int64_t quarter = whole.plan.steps / 4;
    whole.simulation.advance(quarter);
    whole.rain(3);
    whole.simulation.save_checkpoint(here / "c.grs");
    ASSERT_GT(whole.simulation.traffic().left, 2);
    whole.simulation.advance(2 * quarter);
    Scene scene = continued(whole.scene, here / "c.grs");
    SimulatedBed on(scene, whole.plan, 2);
    EXPECT_EQ(on.traffic().came, 2);
    on.pack();
    on.advance(2 * quarter);
    EXPECT_EQ(on.state_hash(), whole.simulation.state_hash());
    EXPECT_EQ(on.traffic().left, whole.simulation.traffic().left);
    // The run starts anew with the grains that are left, so the scene has to give their number.
    scene.start.keep_clock = false;
    EXPECT_THROW(SimulatedBed(scene, whole.plan, 1), UserError);
}

// The bed's grains change; a picture has the colours, trails, chains and arrows of its own frame only.
TEST(TrafficFilm, PicturesShowWhoIsThere) {
    Sink sink(sink_scene({"film.trails.species=[\"big\"]", "film.trails.duration=\"0.1 s\"",
                          "film.force_chains=true", "film.arrows.grid=8", "film.highlight=[3, 17]",
                          "film.colour.by=\"displacement\""}));
    Renderer renderer(sink.scene, 1);
    const std::int64_t every = sink.plan.steps / 20;
    State before = sink.simulation.frame();
    for (int i = 1; i <= 16; ++i) {
        sink.simulation.advance(i * every);
        if (i % 2 == 1) sink.rain(i / 2);
        Shot frame = sink.simulation.frame();
        for (const SavedContact& c : sink.simulation.contacts())
            frame.touches.push_back({c.first, c.second, c.normal});
        const Picture picture = renderer.draw(frame, "");
        if (const char* at = std::getenv("GRAINREEL_LOOK"))
            write_png(std::string(at) + "/sink_" + std::to_string(i) + ".png", picture, {});
        if (i != 16) continue;
        // Nothing of the grains that have gone is left: without trails, a renderer that saw only this frame
        // draws the same.
        FilmedScene plain = sink.scene;
        plain.film.shows.trails = {};
        Renderer one(plain, 1), other(plain, 1);
        one.draw(before, "");
        EXPECT_EQ(one.draw(frame, "").rgba, other.draw(frame, "").rgba);
        EXPECT_NE(one.draw(before, "").rgba, other.draw(frame, "").rgba);
    }
    ASSERT_GT(sink.simulation.traffic().left, 10);
}

}  // namespace
}  // namespace grainreel
