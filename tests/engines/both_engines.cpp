#include "tests/engines/both_engines.hpp"

#include <cmath>
#include <numbers>
#include <thread>

#include "engine/base/team.hpp"
#include "engine/handover/back/dump_tail.hpp"
#include "engine/handover/deck_parts.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/runner/engine_job.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/file/reader.hpp"
#include "engine/state/wall_motion.hpp"
#include "tests/cli/temporary_folder.hpp"

namespace grainreel::test {

namespace {

Course read_theirs(const std::filesystem::path& file, const CarriedScene& carried) {
    Course course;
    DumpTail dump(file);
    const WallMotion motion(carried.scene.drive, carried.plan.clock);
    while (const std::optional<DumpRows> rows = dump.next()) {
        const std::int64_t step = rows->step - carried.shift();
        Moment now;
        now.time = carried.plan.clock.time(step);
        now.radius = rows->radius;
        for (std::size_t i = 0; i < rows->size(); ++i) {
            now.species.push_back(rows->type[i] - 1);
            now.position.push_back(rows->position[i]);
            if (carried.rides()) now.position.back() += motion.at(step).offset;
        }
        course.push_back(std::move(now));
    }
    return course;
}

Course run_ours(const CarriedScene& carried) {
    Course course;
    Simulation run(carried.scene, carried.plan, 1);
    run.pack();
    for (const std::int64_t step : carried.dumps) {
        run.advance(step);
        const Frame frame = run.frame();
        Moment now;
        now.time = frame.time;
        now.species.assign(frame.species.begin(), frame.species.end());
        now.radius = frame.radius;
        now.position = frame.position;
        course.push_back(std::move(now));
    }
    return course;
}

template <class Value>
double mean_from(const Course& course, double from, const Value& value) {
    double sum = 0;
    int moments = 0;
    for (const Moment& now : course)
        if (now.time >= from && now.size() > 0) sum += value(now), ++moments;
    return moments > 0 ? sum / moments : std::nan("");
}

}  // namespace

BothCourses run_both(const std::string& text, const CarryRequest& request) {
    const TemporaryFolder folder;
    const Scene scene = read_scene_text(text, folder / "handed.toml");
    BothCourses both;
    both.carried = carry(scene, make_plan(scene), request);
    throw_refusals(both.carried);
    const StartState start = start_state(both.carried, 1, [](const PackingProgress&) { return true; });
    if (request.engine == PeerEngine::liggghts) make_room_for_walls(both.carried);
    write_handover(folder.path(), both.carried, start, "test");
    EngineJob job(request.engine, request.ranks, deck_name(request.engine));
    job.start(folder.path());
    while (job.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    both.failure = job.failure();
    both.theirs = read_theirs(folder / dump_name(request.engine), both.carried);
    both.ours = run_ours(both.carried);
    return both;
}

bool is_installed(PeerEngine engine) {
    return !program_named(engine == PeerEngine::lammps ? "lmp" : "liggghts").empty() &&
           !program_named("mpirun").empty() && usable_processors() >= 2;
}

double mean_height(const Course& course, double from, int species) {
    return mean_from(course, from, [&](const Moment& now) {
        double sum = 0, grains = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (now.species[i] == species) sum += now.position[i].z(), ++grains;
        return sum / grains;
    });
}

double mean_contacts(const Course& course, double from, double periodic) {
    return mean_from(course, from, [&](const Moment& now) {
        double contacts = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 between = now.position[i] - now.position[j];
                if (periodic > 0) between.x() -= periodic * std::round(between.x() / periodic);
                const double reach = now.radius[i] + now.radius[j];
                contacts += between.squaredNorm() < reach * reach;
            }
        return 2 * contacts / static_cast<double>(now.size());
    });
}

double mean_turning_weight(const Course& course, double from, double density) {
    return mean_from(course, from, [&](const Moment& now) {
        double torque = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            torque += 4.0 / 3 * std::numbers::pi * std::pow(now.radius[i], 3) * density * 9.81 *
                      now.position[i].y();
        return torque;
    });
}

double grains_left(const Course& course) {
    return static_cast<double>(course.front().size()) - static_cast<double>(course.back().size());
}

}  // namespace grainreel::test
