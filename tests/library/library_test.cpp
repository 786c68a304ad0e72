// The library as its users see it: public headers alone.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <grainreel/error.hpp>
#include <grainreel/files.hpp>
#include <grainreel/picture.hpp>
#include <grainreel/run.hpp>
#include <grainreel/simulation.hpp>

#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gr = grainreel;

namespace {

const std::string two_sizes = grainreel::test::SmallScene()
                                  .beads(30, "small", "3 mm", "2.5 g/cm3")
                                  .beads(3, "big", "6 mm", "2.5 g/cm3")
                                  .box("20 mm", "15 mm", "40 mm")
                                  .more("[drive]\nfrequency = \"30 Hz\"\namplitude = \"0.5 mm\"\n")
                                  .lasts("0.05 s")
                                  .more("accuracy = \"draft\"\n")
                                  .text();

gr::Scene scene() {
    return gr::Scene::from_text(two_sizes, "two_sizes.toml");
}

using Folder = grainreel::test::TemporaryFolder;

// A spring with a dashpot, and a number of its own: how many calls the contact has seen.
class Counting final : public gr::ContactLaw {
  public:
    int numbers() const override { return 1; }
    gr::ContactForce force(const gr::Touch& touch, gr::ContactMemory memory) const override {
        if (touch.step > 0) memory.numbers[0] += 1, ++calls;
        if (memory.numbers[0] > throws_after) throw std::out_of_range("too many");
        const double damping = 0.1 * std::sqrt(touch.effective_mass * touch.stiffness);
        return {touch.stiffness * touch.overlap + damping * touch.closing_speed, {}};
    }
    mutable std::atomic<int> calls = 0;
    double throws_after = 1e300;
};

TEST(LibraryErrors, SayWhereTheMistakeIs) {
    try {
        gr::Scene::from_text("title = \"x\"\n[run]\n  duratoin = \"1 s\"\n", "wrong.toml");
        FAIL() << "was read";
    } catch (const gr::Error& error) {
        EXPECT_EQ(error.kind(), gr::Error::Kind::mistake);
        EXPECT_EQ(error.file(), "wrong.toml");
        EXPECT_EQ(error.line(), 3);
        EXPECT_EQ(error.column(), 3);
        EXPECT_NE(std::string(error.what()).find("duration"), std::string::npos) << error.what();
    }
    const gr::Error own("some/file.dat:7: is short");
    EXPECT_EQ(own.file(), "some/file.dat");
    EXPECT_EQ(own.line(), 7);
    EXPECT_EQ(own.column(), 0);
    EXPECT_EQ(gr::Error("nothing of the kind").line(), 0);
    EXPECT_EQ(gr::Error("run/scene.toml: cannot be read").file(), "run/scene.toml");
    EXPECT_EQ(gr::Error("threads: must be at least 0").file(), "");
    EXPECT_THROW(gr::Scene::from_file("/no/such/scene.toml"), gr::Error);
    EXPECT_THROW(scene().contact("huge"), gr::Error);
    EXPECT_THROW(gr::Simulation(scene(), {-1, {}}), gr::Error);
    gr::Simulation simulation(scene());
    EXPECT_THROW(simulation.frame(), gr::Error);  // before it is packed
    EXPECT_THROW(simulation.advance(NAN), gr::Error);
    EXPECT_THROW(simulation.advance_steps(-1), gr::Error);
}

TEST(LibraryRun, HasTheBitsOfAStepByStepRunOnAnyNumberOfThreads) {
    gr::Simulation one(scene(), {1, {}}), two(scene(), {2, {}});
    while (!one.finished()) one.advance_steps(std::min<std::int64_t>(97, scene().steps() - one.step()));
    two.advance(scene().duration());
    EXPECT_EQ(one.state_hash(), two.state_hash());
    int looks = 0;
    gr::RunOptions options;
    options.every = 0.01;
    options.look = [&](const gr::Frame& now) { return now.size() == 33 && ++looks > 0; };
    const gr::RunEnd end = gr::run(scene(), options);
    EXPECT_TRUE(end.complete);
    EXPECT_EQ(looks, 6);  // 0, 0.01, ... 0.05 s
    const gr::Frame last = one.frame();
    for (std::size_t i = 0; i < last.size(); ++i) EXPECT_EQ(end.frame.position[i].z, last.position[i].z);
    EXPECT_THROW(one.measure("centre_zz_m"), gr::Error);
    for (const gr::Measure& measure : one.measures()) {
        if (measure.column != "centre_z_m") continue;
        EXPECT_EQ(measure.value, one.measure("centre_z_m"));
    }
}

// Whether run.json in a run's folder says this word of its end.
bool ended(const std::filesystem::path& folder, const std::string& status) {
    std::ifstream file(folder / "run.json");
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return text.find("\"status\": \"" + status + "\"") != std::string::npos;
}

TEST(LibraryRun, InAFolderAndInMemoryIsTheSame) {
    const Folder here;
    gr::RunOptions options;
    const gr::RunEnd in_memory = gr::run(scene(), options);
    options.folder = here / "run";
    const gr::RunEnd in_folder = gr::run(scene(), options);
    EXPECT_TRUE(in_memory.complete && in_folder.complete);
    ASSERT_EQ(in_memory.frame.size(), in_folder.frame.size());
    for (std::size_t i = 0; i < in_memory.frame.size(); ++i)
        EXPECT_EQ(in_memory.frame.position[i].z, in_folder.frame.position[i].z);
    EXPECT_TRUE(ended(options.folder, "complete"));
    EXPECT_TRUE(std::filesystem::exists(options.folder / "trajectory.nc"));
    EXPECT_THROW(gr::run(scene(), options), gr::Error);  // the folder is not empty
}

TEST(LibraryRun, StopsWhenLookSaysSo) {
    const Folder here;
    for (const std::filesystem::path& folder : {std::filesystem::path(), here / "run"}) {
        std::vector<double> times;
        gr::RunOptions options;
        options.folder = folder;
        options.every = 0.01;
        options.look = [&](const gr::Frame& now) {
            times.push_back(now.time);
            return now.time < 0.025;
        };
        const gr::RunEnd end = gr::run(scene(), options);
        EXPECT_FALSE(end.complete);
        ASSERT_EQ(times.size(), 4u);
        for (std::size_t k = 0; k < times.size(); ++k)
            EXPECT_NEAR(times[k], 0.01 * static_cast<double>(k), 1e-4);
        EXPECT_EQ(end.frame.time, times.back());
    }
    EXPECT_TRUE(ended(here / "run", "interrupted"));
}

TEST(LibraryRun, LetsWhatLookThrowsThrough) {
    const Folder here;
    for (const std::filesystem::path& folder : {std::filesystem::path(), here / "run"}) {
        gr::RunOptions options;
        options.folder = folder;
        options.every = 0.01;
        options.look = [](const gr::Frame&) -> bool { throw std::out_of_range("mine"); };
        EXPECT_THROW(gr::run(scene(), options), std::out_of_range);
    }
    EXPECT_TRUE(ended(here / "run", "interrupted"));
}

// The force on all grains is what walls and gravity do: contacts between grains cancel.
TEST(LibraryContacts, NameGrainsAndWalls) {
    gr::Simulation simulation(scene());
    simulation.pack();
    const auto walls = static_cast<std::int32_t>(scene().walls().size());
    double weight = 0, carried = 0;
    const gr::Frame now = simulation.frame();
    for (const double radius : now.radius) weight += 9.81 * 2500 * 4.0 / 3 * M_PI * std::pow(radius, 3);
    for (const gr::Contact& contact : simulation.contacts()) {
        ASSERT_GE(contact.second, -walls);
        EXPECT_NEAR(std::hypot(contact.normal.x, contact.normal.y, contact.normal.z), 1, 1e-12);
        if (contact.second < 0)
            carried += contact.normal_force * contact.normal.z + contact.tangential_force.z;
    }
    EXPECT_NEAR(carried, -weight, 0.1 * weight);  // what the grains do to the walls is on them
}

TEST(LibraryLaw, IsCalledForItsContactsAndKeepsItsMemory) {
    const auto all = std::make_shared<Counting>(), walls = std::make_shared<Counting>();
    gr::SimulationOptions options{1, {{all, {}, {}}, {walls, "big", "walls"}}};
    gr::Simulation one(scene(), options);
    one.advance(0.02);
    EXPECT_GT(all->calls, 1000);
    EXPECT_GT(walls->calls, 100);
    EXPECT_LT(walls->calls, all->calls);

    const Folder folder;
    one.save_checkpoint(folder / "there.grs");
    one.advance(0.04);
    options.threads = 2;
    gr::Simulation again = gr::Simulation::from_checkpoint(scene(), folder / "there.grs", options);
    EXPECT_NEAR(again.time(), 0.02, scene().step());
    again.advance(0.04);
    EXPECT_EQ(again.state_hash(), one.state_hash());
    EXPECT_TRUE(std::isnan(one.measure("elastic_J")));  // the law does not tell
}

TEST(LibraryLaw, IsRefusedOrItsExceptionComesOut) {
    EXPECT_THROW(gr::Simulation(scene(), {1, {{nullptr, {}, {}}}}), gr::Error);
    EXPECT_THROW(gr::Simulation(scene(), {1, {{std::make_shared<Counting>(), "middle", {}}}}), gr::Error);
    const auto law = std::make_shared<Counting>();
    law->throws_after = 20;
    gr::Simulation simulation(scene(), {2, {{law, {}, {}}}});
    EXPECT_THROW(simulation.advance(0.02), std::out_of_range);
}

TEST(LibraryTraffic, PutsGrainsInAndTakesThemOut) {
    gr::Simulation simulation(scene());
    simulation.pack();
    const gr::Frame before = simulation.frame();
    EXPECT_THROW(simulation.insert({{0, 0.0015, 0, before.position[3], {}, {}}}), gr::Error);
    EXPECT_THROW(simulation.insert({{0, 0.5, 0, {0, 0, 0.03}, {}, {}}}), gr::Error);
    EXPECT_THROW(simulation.insert({{2, 0.0015, 0, {0, 0, 0.03}, {}, {}}}), gr::Error);
    EXPECT_EQ(simulation.insert({{0, 0.0015, 0, {0, 0, 0.03}, {}, {}}}), 33);
    simulation.advance(0.01);
    const gr::Frame now = simulation.frame();
    EXPECT_EQ(now.size(), 34U);
    EXPECT_NEAR(now.position.back().z, 0.03 - 9.81 * simulation.time() * simulation.time() / 2, 1e-8);
    simulation.remove({33, 0});
    EXPECT_EQ(simulation.frame().size(), 32U);
    EXPECT_THROW(simulation.remove({0}), gr::Error);
}

TEST(LibraryFiles, ReadWhatTheyWrote) {
    const Folder folder;
    gr::World world;
    world.species = {"a", "b"};
    world.density = {2500, 7800};
    gr::FrameWriter writer(folder / "some.csv", "csv", world);
    for (int k = 0; k < 3; ++k) {
        gr::Frame frame;
        frame.step = 10 * k;
        frame.time = 0.25 * k;
        frame.add({0.001, 0.002, 0.003 + k}, 0.0005);
        frame.add({0.004, 0.005, 0.006 + k}, 0.00075, 1);
        frame.velocity[1] = {1, 2, 3.5};
        writer.write(frame);
    }
    gr::Frame bad;
    bad.time = 1;
    bad.add({0, 0, 0}, -1);
    EXPECT_THROW(writer.write(bad), gr::Error);  // a radius below 0
    bad.radius[0] = 1, bad.species[0] = 2;
    EXPECT_THROW(writer.write(bad), gr::Error);  // no such species
    bad.species[0] = 0, bad.time = 0.1;
    EXPECT_THROW(writer.write(bad), gr::Error);  // earlier than the last one
    bad.radius.clear();
    EXPECT_THROW(writer.write(bad), gr::Error);
    writer.close();
    EXPECT_THROW(gr::FrameWriter(folder / "some.csv", "csv", world), gr::Error);
    EXPECT_THROW(gr::FrameWriter(folder / "new.csv", "cvs", world), gr::Error);

    const gr::FrameFile file(folder / "some.csv");
    ASSERT_EQ(file.size(), 3U);
    EXPECT_EQ(file.nearest(0.3), 1U);
    const gr::Frame frame = file.frame(2);
    ASSERT_EQ(frame.size(), 2U);
    EXPECT_EQ(frame.time, 0.5);
    EXPECT_EQ(frame.position[1].z, 2.006);
    EXPECT_EQ(frame.velocity[1].z, 3.5);
    EXPECT_EQ(frame.radius[1], 0.00075);
    EXPECT_THROW(file.frame(3), gr::Error);
    EXPECT_THROW(gr::FrameFile(folder / "none"), gr::Error);
}

TEST(LibraryPicture, DrawsTheSameTwiceAndRefusesNonsense) {
    gr::World world;
    world.species = {"ball"};
    world.walls = {gr::Mesh::box("box", {-0.01, -0.01, 0}, {0.01, 0.01, 0.02})};
    gr::Frame frame;
    frame.add({0, 0, 0.01}, 0.004);
    gr::Painter painter(world, frame, {"film.size=160x120", "species.ball.colour=#ff0000"});
    const gr::Picture once = painter.draw(frame), twice = painter.draw(frame);
    EXPECT_EQ(once.width, 160);
    EXPECT_EQ(once.height, 120);
    EXPECT_EQ(once.rgba, twice.rgba);
    int red = 0;
    for (std::size_t p = 0; p < once.rgba.size(); p += 4)
        red += once.rgba[p] > once.rgba[p + 1] + 80 && once.rgba[p] > once.rgba[p + 2] + 80;
    EXPECT_GT(red, 100);
    // Another place of the wall, by its pose, is another picture.
    frame.bodies.resize(3);
    frame.bodies[2].place = {0, 0.004, 0};
    EXPECT_NE(painter.draw(frame).rgba, once.rgba);

    frame.species[0] = 1;
    EXPECT_THROW(painter.draw(frame), gr::Error);
    frame.species[0] = 0;
    EXPECT_THROW(gr::Painter(world, frame, {"film.sise=1x1"}), gr::Error);
    world.walls[0].triangles[0][0] = 99;
    EXPECT_THROW(gr::Painter(world, frame), gr::Error);
    EXPECT_THROW(gr::Painter(gr::World{}, frame), gr::Error);
    EXPECT_THROW((gr::Picture{2, 2, {0}}.write_png("/tmp/no.png")), gr::Error);
    EXPECT_THROW(once.write_png("/no/such/folder/x.png"), gr::Error);
}

// Frames of a simulation, with the walls and colours of its scene.
TEST(LibraryPicture, DrawsAScene) {
    gr::Simulation simulation(scene());
    simulation.pack();
    gr::Painter painter(scene(), {"film.size=160x120"});
    const gr::Picture first = painter.draw(simulation.frame());
    simulation.advance(0.02);
    EXPECT_NE(painter.draw(simulation.frame()).rgba, first.rgba);
}

}  // namespace
