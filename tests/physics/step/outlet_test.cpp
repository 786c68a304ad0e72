// Tests of an open outlet, where plates end at edges: closed forms of a grain at an edge, and the account of
// mass and energy of a bed that runs out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/measure/columns.hpp"
#include "engine/measure/energy.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/surroundings.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

constexpr double kGap = 0.01;  // m, half of the outlet

Container container_with(Container::Shape shape, Outlet::Shape outlet) {
    Container c;
    c.shape = shape;
    c.half_width = 0.05;
    c.depth = 0.06;
    c.height = 0.1;
    c.outlet = Outlet{outlet, kGap, 0, 0.05};
    if (shape == Container::Shape::wedge) c.half_angle = 0.5, c.slant_height = 0.06;
    return c;
}

std::vector<Face> open_faces(const Container& c) {
    std::vector<Face> faces = container_faces(c, Drive{});
    open_outlet(c, faces);
    return faces;
}

const Face& named(const std::vector<Face>& faces, const std::string& name) {
    for (const Face& face : faces)
        if (face.name == name) return face;
    throw std::runtime_error(name);
}

void expect_distance(const Face& face, const Vec3& centre, double distance, const Vec3& away) {
    const FaceDistance at = distance_to(face, Vec3::Zero(), centre);
    EXPECT_NEAR(at.distance, distance, 1e-15) << face.name;
    EXPECT_LT((at.normal - away.normalized()).norm(), 1e-12) << face.name;
}

TEST(Outlet, FloorOfABoxEndsAtTheSlot) {
    const Face floor = named(open_faces(container_with(Container::Shape::box, Outlet::Shape::slot)), "floor");
    expect_distance(floor, {0.01, -0.03, 0.004}, 0.004, {0, 0, 1});
    expect_distance(floor, {0.01, 0.03, -0.004}, 0.004, {0, 0, -1});  // from below
    for (const double side : {-1.0, 1.0}) {
        expect_distance(floor, {0.01, side * 0.007, 0.004}, 0.005, {0, -side * 3, 4});
        expect_distance(floor, {-0.02, side * 0.007, -0.004}, 0.005, {0, -side * 3, -4});
    }
}

TEST(Outlet, FloorOfACylinderEndsAtTheHole) {
    const Face floor =
        named(open_faces(container_with(Container::Shape::cylinder, Outlet::Shape::hole)), "floor");
    expect_distance(floor, {0.012, 0.009, 0.004}, 0.004, {0, 0, 1});  // 0.015 from the axis
    // 0.007 from the axis, along (0.6, 0.8).
    expect_distance(floor, {0.0042, 0.0056, 0.004}, 0.005, {-0.6 * 3, -0.8 * 3, 4});
}

TEST(Outlet, WallsEndBelow) {
    const auto box = open_faces(container_with(Container::Shape::box, Outlet::Shape::slot));
    expect_distance(named(box, "front"), {0.027, 0, 0.02}, 0.003, {-1, 0, 0});
    expect_distance(named(box, "front"), {0.027, 0, -0.004}, 0.005, {-3, 0, -4});
    const auto tube = open_faces(container_with(Container::Shape::cylinder, Outlet::Shape::hole));
    expect_distance(named(tube, "wall"), {0.028, 0.0, 0.02}, 0.022, {-1, 0, 0});
    expect_distance(named(tube, "wall"), {0.6 * 0.047, 0.8 * 0.047, -0.004}, 0.005, {-0.6 * 3, -0.8 * 3, -4});
    const Container c = container_with(Container::Shape::wedge, Outlet::Shape::slot);
    const auto wedge = open_faces(c);
    const double half = c.floor_half_width();
    const Vec3 normal(0, -std::cos(c.half_angle), std::sin(c.half_angle));
    const Vec3 up(0, std::sin(c.half_angle), std::cos(c.half_angle)), foot(0, half, 0);
    expect_distance(named(wedge, "right slant"), foot + 0.01 * up + 0.004 * normal, 0.004, normal);
    expect_distance(named(wedge, "right slant"), foot - 0.003 * up + 0.004 * normal, 0.005,
                    4 * normal - 3 * up);
}

// An outlet as wide as the floor leaves the slants' edges alone.
TEST(Outlet, MayTakeTheWholeFloor) {
    Container c = container_with(Container::Shape::wedge, Outlet::Shape::slot);
    c.outlet->half_width = c.floor_half_width() * (1 - 1e-12);  // all of the floor but for rounding
    const auto faces = open_faces(c);
    const Vec3 centre(0, c.floor_half_width() - 0.001, 0);
    EXPECT_GT(distance_to(named(faces, "floor"), Vec3::Zero(), centre).distance, 1e6);
    EXPECT_NEAR(distance_to(named(faces, "right slant"), Vec3::Zero(), centre).distance, 0.001, 1e-15);
}

// The vectorised step computes what the formulas say, at all faces and edges.
TEST(Outlet, ContactsHaveOverlapAndNormalOfTheFormula) {
    for (const auto& [shape, outlet] : {std::pair{Container::Shape::box, Outlet::Shape::slot},
                                        {Container::Shape::box, Outlet::Shape::hole},
                                        {Container::Shape::cylinder, Outlet::Shape::hole},
                                        {Container::Shape::wedge, Outlet::Shape::slot}}) {
        const Container c = container_with(shape, outlet);
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.3), 1e-7);
        w.around.faces = open_faces(c);
        std::int32_t id = 0;
        for (int x = -20; x <= 20; ++x)
            for (int y = -20; y <= 20; ++y)
                for (int z = -2; z <= 2; ++z)
                    w.grains.add(id++, 0, Vec3(1.7e-3 * x, 2.6e-3 * y, 1.1e-3 * z + 2e-4), 0.8e-3, kDensity);
        // The grains are far from each other, so only walls are looked at.
        w.plan.grain[0].loading_stiffness = w.plan.grain[0].unloading_stiffness = 1e-9;
        w.around.skin = 1e-4;
        w.start();
        w.run(1);
        std::size_t seen = 0, expected = 0;
        w.loop->visit_contacts(w.step, [&](const ContactView& v) {
            if (v.second >= 0) return;
            const FaceDistance at =
                distance_to(w.around.faces[-1 - v.second], Vec3::Zero(), w.grains.place[v.first].position);
            EXPECT_NEAR(v.overlap, 0.8e-3 - at.distance, 1e-15);
            EXPECT_LT((v.normal + at.normal).norm(), 1e-12);
            ++seen;
        });
        for (const Place& place : w.grains.place)
            for (const Face& face : w.around.faces)
                expected += distance_to(face, Vec3::Zero(), place.position).distance < 0.8e-3;
        EXPECT_EQ(seen, expected) << static_cast<int>(shape);
        EXPECT_GT(seen, 300u);
    }
}

// A ball at rest at the edge of a slot or of a wide hole, at an angle (rad) from the vertical.
HandMadeBed at_the_edge(double angle, double friction, Outlet::Shape shape = Outlet::Shape::slot) {
    PairPlan pair = walton_braun_pair(1, friction);
    HandMadeBed w =
        make_world(pair, 0.05 * std::sqrt(sphere_mass() / kStiffness), NormalForce::spring_dashpot,
                   friction > 0 ? TangentialLaw::linear_spring : TangentialLaw::none);
    Container c = container_with(Container::Shape::box, shape);
    w.around.faces = open_faces(c);
    w.around.gravity = {0, 0, -9.81};
    const double overlap = sphere_mass() * 9.81 * std::cos(angle) / kStiffness;
    w.grains.add(0, 0, Vec3(0, -kGap, 0) + (kRadius - overlap) * Vec3(0, std::sin(angle), std::cos(angle)),
                 kRadius, kDensity);
    w.start();
    return w;
}

// A ball that is let go at rest at theta0 and turns about the edge keeps
//   (1 + q) r w^2 / 2 = g (cos theta0 - cos theta), where q is 2/5 if it rolls and 0 if it slides,
// and is pressed against the edge by m (g cos theta - r w^2). It leaves where
//   cos theta = 2 cos theta0 / (3 + q).
TEST(Outlet, ABallLeavesTheEdgeAtTheAngleOfTheClosedForm) {
    for (const double friction : {0.0, 1e3})
        for (const Outlet::Shape shape : {Outlet::Shape::slot, Outlet::Shape::hole}) {
            const double start = 0.2, q = friction > 0 ? 0.4 : 0;
            HandMadeBed w = at_the_edge(start, friction, shape);
            const double before = w.energy();
            double left_at = 0;
            while (left_at == 0 && w.step < 200000) {
                w.run(4);
                int contacts = 0;
                w.loop->visit_contacts(w.step, [&](const ContactView&) { ++contacts; });
                ASSERT_LE(contacts, 1);
                const Vec3 from_edge = w.position(0) + Vec3(0, kGap, 0);
                if (contacts == 0) left_at = std::atan2(from_edge.y(), from_edge.z());
                ASSERT_NEAR(w.energy(), before, of_rounding(1e-6, 1e-4) * before);
            }
            EXPECT_NEAR(std::cos(left_at), 2 * std::cos(start) / (3 + q), of_rounding(1e-3, 5e-3))
                << friction;
            if (friction > 0) {  // without slip it turns as fast as it moves
                EXPECT_NEAR(-w.spin(0).x() * kRadius, w.velocity(0).norm(), 1e-3 * w.velocity(0).norm());
            }
        }
}

// A ball rolls down a floor that leans, and over its edge. The friction that holds it, 2/7 of m g sin(lean),
// goes on across the edge because the contact stays the same one.
TEST(Outlet, FrictionGoesOnFromTheFloorToItsEdge) {
    const double lean = 0.3;
    HandMadeBed w = at_the_edge(0, 1e3);
    w.around.gravity = 9.81 * Vec3(0, std::sin(lean), -std::cos(lean));
    w.grains.place[0].position.y() -= 0.2 * kRadius;
    w.plan.wall[0].normal_damping = 0;
    w.start();
    const double weight = sphere_mass() * 9.81, before = w.energy();
    bool on_floor = false, on_edge = false;
    double held = 0;  // mean over the spring's own swing
    while (w.position(0).y() < -kGap + 0.05 * kRadius) {
        w.run(1);
        w.loop->visit_contacts(w.step, [&](const ContactView& c) {
            held += 0.003 * (c.tangential.norm() - held);
            const bool edge = w.position(0).y() > -kGap;
            if (w.step > 3000) {
                EXPECT_NEAR(held, 2.0 / 7 * weight * std::sin(lean), 0.05 * weight) << w.step;
            }
            (edge ? on_edge : on_floor) = true;
        });
        ASSERT_LT(w.step, 100000);
    }
    EXPECT_TRUE(on_floor && on_edge);
    EXPECT_NEAR(w.energy(), before, of_rounding(1e-5, 1e-3) * std::abs(before));
}

// An open floor has two faces: a grain that comes from below, in a tray that is full, bounces off it like one
// from above. It comes back with -e v, and the floor lets no grain through.
TEST(Outlet, TheFloorIsAWallFromBelowToo) {
    const double e = 0.7, speed = 0.4, natural = std::sqrt(sphere_mass() / kStiffness);
    for (const double side : {1.0, -1.0}) {
        HandMadeBed w = make_world(walton_braun_pair(e, 0.3), natural / 200);
        w.around.faces = open_faces(container_with(Container::Shape::box, Outlet::Shape::slot));
        w.grains.add(0, 0, Vec3(0, 0.03, side * 1.05 * kRadius), kRadius, kDensity);
        w.grains.motion[0].velocity = Vec3(0, 0, -side * speed);
        w.start();
        w.run(static_cast<std::int64_t>((0.1 * kRadius / speed + 4 * natural) / w.plan.clock.step));
        EXPECT_NEAR(w.velocity(0).z(), side * e * speed, of_rounding(2e-3, 4e-3) * speed) << side;
        EXPECT_GT(side * w.position(0).z(), kRadius) << side;
    }
}

// A ball rests on the floor where the outlet opens. From then on it falls freely: the last force of the floor
// does not act for half a step more.
TEST(Outlet, TheGateDoesNotPushAnyMoreOnceItIsOpen) {
    HandMadeBed w = at_the_edge(0, 0);
    Container c = container_with(Container::Shape::box, Outlet::Shape::slot);
    w.around.faces = container_faces(c, Drive{});
    w.grains.place[0].position.y() = 0;
    w.start();
    w.run(10);
    ASSERT_NEAR(w.velocity(0).z(), 0, 1e-9);
    w.loop->open_faces([&] { open_outlet(c, w.around.faces); }, w.step);
    const double before = w.velocity(0).z();
    w.run(100);
    EXPECT_NEAR(w.velocity(0).z() - before, -9.81 * 100 * w.plan.clock.step, 1e-9);
}

// The law gets the turn of a contact as Cayley's vector of the turn from the normal before the step to the
// normal after it. For a small turn this is 0.5 n x n', with normals from distance_to().
TEST(Outlet, ContactsTurnAsTheirNormalsDo) {
    const double step = 1e-6;
    const Vec3 velocity(0.7, -0.5, 0.9);
    int turned = 0;
    for (const auto& [shape, outlet] : {std::pair{Container::Shape::box, Outlet::Shape::slot},
                                        {Container::Shape::box, Outlet::Shape::hole},
                                        {Container::Shape::cylinder, Outlet::Shape::hole},
                                        {Container::Shape::wedge, Outlet::Shape::slot}}) {
        const Container c = container_with(shape, outlet);
        const std::vector<Face> faces = open_faces(c);
        WallState walls;
        walls.set(faces, DrivePose(), DrivePose(), step);
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (int k = 0; k < 400; ++k) {
                // The place goes around the floor's rim and the foot of the walls.
                const double angle = 0.37 * k, z = 3e-4 * (k % 11 - 5) + 7e-5;
                const double out = (k % 2 == 0 ? kGap : c.floor_half_width()) - 8e-4 * (k % 3) - 1.3e-4;
                Grains grains;
                grains.add(0, 0, Vec3(out * std::cos(angle), out * std::sin(angle), z), kRadius, kDensity);
                grains.motion[0].velocity = velocity;
                const std::vector<std::int32_t> first(kBlock, 0),
                    second(kBlock, static_cast<std::int32_t>(f));
                TouchChunk touch;
                touch_plates({&grains, first.data(), second.data(), 1, Wants::spin, LeverArms::contact_plane,
                              step, step, nullptr},
                             walls, touch);
                const Vec3 now = grains.place[0].position, before = now - step * velocity;
                const FaceDistance end = distance_to(faces[f], Vec3::Zero(), now),
                                   start = distance_to(faces[f], Vec3::Zero(), before);
                if (end.distance > 0.99 * kRadius || end.distance < 0.05 * kRadius) continue;
                const Vec3 expected = 0.5 * start.normal.cross(end.normal);
                const Vec3 turn(touch.turn[0][0], touch.turn[1][0], touch.turn[2][0]);
                EXPECT_LT((turn - expected).norm(), 0.02 * expected.norm() + 1e-12) << faces[f].name << k;
                turned += expected.norm() > 1e-9;
            }
    }
    EXPECT_GT(turned, 300);
}

const std::string kBox =
    test::SmallScene("title = \"outlet\"\n")
        .beads(120, "grain", "3 mm to 4 mm")
        .contacts("0.7", "0.4")
        .box("30 mm", "20 mm", "60 mm")
        .more("top = \"open\"\n")
        .more("outlet = { width = \"14 mm\", opens = \"0.05 s\", exit_depth = \"15 mm\" }\n")
        .shaken("30 Hz", "2")
        .lasts("0.3 s")
        .more("overlap = 0.05\n")
        .text();

Scene scene_of(std::vector<std::string> sets = {}) {
    return read_scene_text(kBox, "outlet.toml", with_tested_precision(std::move(sets)));
}

// A single grain above the outlet leaves in the first step n with z0 - g (n dt)^2 / 2 < -exit_depth.
TEST(Outlet, AGrainThatFallsThroughLeavesInTheStepOfFreeFall) {
    const Scene scene = read_scene_text(
        test::SmallScene("title = \"one\"\ngravity = 9.81\n")
            .beads(0, "grain")
            .contacts("0.7", "0")
            .cylinder("40 mm", "60 mm")
            .more("top = \"open\"\noutlet = { diameter = \"25 mm\", exit_depth = \"40 mm\" }\n")
            .more("[[grain]]\nposition = [0.002, -0.003, 0.03]\n")
            .lasts("0.2 s")
            .more("[start]\nmethod = \"grains\"\n")
            .text(),
        "one.toml", with_tested_precision({}));
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.steps);
    EXPECT_EQ(run.grains(), 0u);
    const std::vector<Departure> gone = run.take_departures();
    ASSERT_EQ(gone.size(), 1u);
    const double dt = plan.clock.step;
    EXPECT_EQ(gone[0].step, static_cast<std::int64_t>(std::ceil(std::sqrt(2 * 0.07 / 9.81) / dt)));
    EXPECT_NEAR(gone[0].velocity.z(), -9.81 * dt * static_cast<double>(gone[0].step), 1e-9);
}

TEST(Outlet, ABedRunsOutAlikeOnAnyNumberOfThreadsAndThroughACheckpoint) {
    for (const char* size : {"width = \"14 mm\"", "diameter = \"16 mm\""}) {
        std::string text = kBox;
        text.replace(text.find("width = \"14 mm\""), std::string("width = \"14 mm\"").size(), size);
        const Scene scene = read_scene_text(
            text, "outlet.toml", with_tested_precision({"run.duration=0.13 s", "species.grain.count=70"}));
        const Plan plan = make_plan(scene);
        ASSERT_TRUE(plan.opens);
        std::uint64_t bits = 0;
        const test::TemporaryFolder folder;
        const std::filesystem::path opened = folder / "opened.grs", later = folder / "later.grs";
        for (const int threads : {1, 2, 3}) {
            SimulatedBed run(scene, plan, threads);
            run.pack();
            run.advance(*plan.opens);
            EXPECT_EQ(run.traffic().left, 0);
            if (threads == 1) run.save_checkpoint(opened);
            run.advance((*plan.opens + plan.steps) / 2);
            if (threads == 1) run.save_checkpoint(later);
            run.advance(plan.steps);
            if (threads == 1) bits = run.state_hash();
            EXPECT_EQ(run.state_hash(), bits) << threads;
            EXPECT_GT(run.traffic().left, 10);
        }
        for (const std::filesystem::path& file : {opened, later}) {
            const Scene next = continued(scene, file);
            SimulatedBed on(next, plan, 2);
            on.advance(plan.steps);
            EXPECT_EQ(on.state_hash(), bits) << file;
        }
    }
}

// Every grain is there or has left, and energy that was lost never comes back.
TEST(Outlet, MassAndEnergyAreAccountedFor) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const auto mass_of = [](double radius) {
        return 2500 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
    };
    const auto mass_there = [&] {
        double mass = 0;
        for (const double radius : run.frame().radius) mass += mass_of(radius);
        return mass;
    };
    const double before = mass_there();
    double left = 0, lost = 0;
    for (int look = 1; look <= 20; ++look) {
        run.advance(look * plan.steps / 20);
        for (const Departure& gone : run.take_departures()) {
            left += mass_of(gone.radius);
            EXPECT_LT(gone.position.z(), -0.015);
            EXPECT_LT(gone.velocity.z(), 0);
            EXPECT_LT(std::abs(gone.position.y()), 0.02) << "through the slot";
        }
        EXPECT_NEAR(mass_there() + left, before, 1e-12 * before);
        const Measures m = run.measures();
        const double now = m.at("lost_J");
        EXPECT_GT(now, lost - 1e-3 * m.at("wall_work_J") - 1e-5 * before * 9.81 * 0.05) << look;
        lost = now;
    }
    EXPECT_GT(run.traffic().left, 80);
}

// A feed gives grains while others leave. The columns of the instrument are those of the departures, in one
// go and from a checkpoint on.
TEST(Outlet, WhatFlowsOutIsKnownWhileAFeedGivesGrains) {
    const std::string text = std::string(kBox) + "[[feed]]\nrate = 700\nuntil = \"0.09 s\"\n" +
                             "[output]\ninstruments = [\"outflow\"]\nmeasures_interval = \"5 ms\"\n";
    const Scene scene = read_scene_text(
        text, "outlet.toml", with_tested_precision({"species.grain.count=70", "run.duration=0.14 s"}),
        measurable_in);
    const Plan plan = make_plan(scene);
    const test::TemporaryFolder folder;
    const std::filesystem::path half = folder / "half.grs";
    std::vector<std::vector<double>> rows;
    double left = 0, flowed = 0, last = 0;
    const auto go_on = [&](SimulatedBed& run, bool save) {
        std::vector<std::vector<double>> found;
        for (std::int64_t row = std::llround(static_cast<double>(run.step()) / plan.measures_every) + 1;
             row <= 28; ++row) {
            run.advance(std::llround(static_cast<double>(row) * plan.measures_every));
            const Measures m = run.measures();
            found.push_back(m.values());
            if (!save) continue;
            for (const Departure& gone : run.take_departures())
                left += 2500 * 4.0 / 3 * std::numbers::pi * std::pow(gone.radius, 3);
            flowed += m.at("outflow_rate") * (m.at("time_s") - last);
            last = m.at("time_s");
            EXPECT_NEAR(m.at("outflow_kg"), left, 1e-12 * left) << row;
            if (row == 18) run.save_checkpoint(half);
        }
        return found;
    };
    SimulatedBed run(scene, plan, 1);
    run.pack();
    rows = go_on(run, true);
    EXPECT_NEAR(flowed, left, 1e-9 * left);
    EXPECT_GT(run.traffic().left, 10);
    EXPECT_GT(run.traffic().came, 50);
    SimulatedBed again = SimulatedBed::at_checkpoint(scene, plan, half, 2);
    const auto later = go_on(again, false);
    ASSERT_EQ(later.size(), rows.size() - 18);
    for (std::size_t k = 0; k < later.size(); ++k)
        for (std::size_t c = 0; c < later[k].size(); ++c)
            EXPECT_TRUE(later[k][c] == rows[18 + k][c] || std::isnan(later[k][c])) << k << " " << c;
}

// The energy balances term by term, also if an outlet opens below a bed at rest.
TEST(Outlet, OpeningBalances) {
    const Scene scene = scene_of({"drive={}", "container.outlet.opens=0 s"});
    const Plan plan = make_plan(scene);
    Surroundings around = make_surroundings(scene, plan);
    HandMadeBed w;
    w.plan = plan;
    w.around = around;
    for (int i = 0; i < 36; ++i)
        w.grains.add(i, 0,
                     Vec3(4.05e-3 * (i % 4) - 0.006, 4.05e-3 * (i / 4 % 3) - 0.004, 2e-3 + 4e-3 * (i / 12)),
                     2e-3, 2500);
    w.start();
    w.run(20000);
    EnergyBalance balance(w.around, w.grains, *w.loop, w.step, plan.clock.step);
    w.run(1);
    balance.note(w.step);
    const double stored = summarise_contacts(*w.loop, w.step).stored;
    w.loop->open_faces([&] { open_outlet(scene, w.around); }, w.step);
    EXPECT_GT(w.loop->traffic().energy_out, 0.05 * stored) << "what the gate's contacts held";
    double worst = 0;
    while (w.step < 40000 && w.grains.size() > 0) {
        w.run(1);
        balance.note(w.step);
        worst = std::max(worst, std::abs(balance.residual()));
    }
    EXPECT_GT(w.loop->traffic().left, 10);
    EXPECT_LT(worst, 1e-3 * (balance.terms().lost() + std::abs(balance.terms().left)));
}

}  // namespace
}  // namespace grainreel
