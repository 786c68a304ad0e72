#include "engine/files/frames/same_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/rotation.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/drive_motion.hpp"

namespace grainreel {

namespace {

constexpr double same_size = 1e-4;   // relative; an early version kept radii as floats
constexpr double same_time = 1e-6;   // relative; in turns for a phase
constexpr double same_place = 1e-6;  // as a share of the drive's amplitude or speed, or of a diameter
constexpr double same_angle = 1e-6;  // rad
constexpr double same_shape = 1e-9;  // relative to a mesh's extent

[[noreturn]] void of_two_runs(const std::string& what) {
    throw UserError(what + "; they are of two runs");
}

void check_times(const Scene& scene, double step_length, double step, double time, double cycles,
                 const std::string& file) {
    if (scene.run.step && std::abs(time - step * *scene.run.step) > same_time * std::abs(time))
        of_two_runs(
            fmt::format("{} has {:.6g} s at step {:.0f}, but by scene.toml beside it a step is {:.6g} s",
                        file, time, step, *scene.run.step));
    if (std::abs(time - step * step_length) > same_time * std::abs(time))
        of_two_runs(
            fmt::format("{} has {:.6g} s at step {:.0f}, but in trajectory.nc beside it a step is {:.6g} s",
                        file, time, step, step_length));
    const double frequency = scene.drive.present ? scene.drive.frequency : 0;
    const double periods = scene.drive.changes() && time > 0 ? DriveSchedule(scene.drive).times().cycles(time)
                                                             : time * frequency;
    if (std::abs(cycles - periods) > same_time * (1 + std::abs(cycles)))
        of_two_runs(
            fmt::format("{} has {:.6g} periods of the drive at {:.6g} s, but scene.toml beside it has {}",
                        file, cycles, time,
                        scene.drive.changes() ? fmt::format("{:.6g}", periods)
                        : frequency > 0       ? fmt::format("{:.6g} Hz", frequency)
                                              : "no drive"));
}

void check_pose(const Drive& drive, const BodyPose& pose, const DrivePose& by_scene,
                const std::string& what) {
    const auto near = [](const Vec3& a, const Vec3& b, double scale) {
        return (a - b).norm() <= same_place * std::max(scale, a.norm());
    };
    const DrivePeaks peaks = drive_peaks(drive);
    if (near(pose.place, by_scene.offset, peaks.offset) &&
        near(pose.velocity, by_scene.velocity, peaks.speed))
        return;
    const auto along = [&](const Vec3& vector) { return vector.dot(drive.direction); };
    of_two_runs(fmt::format(
        "{} {:.4g} m from rest along the drive, at {:.4g} m/s, but the drive of scene.toml "
        "beside it has it at {:.4g} m and {:.4g} m/s then",
        what, along(pose.place), along(pose.velocity), along(by_scene.offset), along(by_scene.velocity)));
}

// Checks the pose of a body that has a motion of its own.
void check_own_pose(const BodyPose& pose, const BodyPose& by_scene, const std::string& what) {
    const auto near = [](const Vec3& a, const Vec3& b) {
        return (a - b).norm() <= same_place * std::max({1.0, a.norm(), b.norm()});
    };
    const double apart = angle_between(pose.rotation, by_scene.rotation);
    if (near(pose.place, by_scene.place) && near(pose.velocity, by_scene.velocity) &&
        near(pose.spin, by_scene.spin) && apart <= same_angle)
        return;
    of_two_runs(fmt::format("{} {:.4g} degrees and {:.4g} m off where scene.toml beside it has it then", what,
                            apart * 180 / std::numbers::pi, (pose.place - by_scene.place).norm()));
}

// Checks the pose of the container, if it turns, and of the meshes.
void check_own_poses(const Scene& scene, const DrivePose& drive, const State& moment,
                     const std::string& frame) {
    const std::vector<Body> bodies = bodies_of(scene);
    if (scene.container.turn)
        check_own_pose(moment.container(), bodies[kContainerBody].at(drive), frame + " has the container");
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const std::size_t body = static_cast<std::size_t>(first_mesh_body(scene)) + m;
        check_own_pose(moment.body(body), bodies[body].at(drive),
                       fmt::format("{} has the mesh '{}'", frame, scene.meshes[m].name));
    }
}

}  // namespace

void check_species(const Scene& scene, const StoredWorld& world, const std::string& trajectory) {
    if (world.species.size() != scene.species.size())
        of_two_runs(fmt::format("{}: has {} species, but scene.toml beside it has {}", trajectory,
                                world.species.size(), scene.species.size()));
}

void check_meshes(const Scene& scene, const StoredWorld& in_file, const std::string& trajectory) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const TriangleMesh& by_scene = mesh.surface->mesh();
        const std::size_t body = static_cast<std::size_t>(first_mesh_body(scene)) + m;
        if (body >= in_file.bodies.size())
            of_two_runs(
                fmt::format("{}: has no mesh '{}', but scene.toml beside it has", trajectory, mesh.name));
        const TriangleMesh& shape = in_file.bodies[body].mesh;
        const double room = same_shape * mesh.surface->farthest_from(Vec3(0, 0, 0));
        const bool alike = shape.triangles == by_scene.triangles &&
                           std::equal(shape.vertices.begin(), shape.vertices.end(), by_scene.vertices.begin(),
                                      by_scene.vertices.end(),
                                      [&](const Vec3& a, const Vec3& b) { return (a - b).norm() <= room; });
        if (!alike)
            of_two_runs(fmt::format(
                "{}: its mesh '{}' ({} triangles) has another shape than that of scene.toml beside it ({})",
                trajectory, in_file.bodies[body].name, shape.triangles.size(), by_scene.triangles.size()));
    }
}

void check_grains(const Scene& scene, const StoredWorld& world, const State& frame,
                  const std::string& trajectory) {
    const auto grains = static_cast<std::int64_t>(world.most_grains);
    if (grains != scene.grains() && !world.traffic)
        of_two_runs(fmt::format("{}: has {}, but scene.toml beside it has {}", trajectory,
                                counted(grains, "grain"), scene.grains()));
    std::vector<std::int64_t> count(scene.species.size(), 0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto of = static_cast<std::size_t>(frame.species[i]);
        const Species& species = scene.species[of];
        ++count[of];
        const double diameter = 2 * frame.radius[i];
        if (diameter < species.diameter.smallest * (1 - same_size) ||
            diameter > species.diameter.largest * (1 + same_size))
            of_two_runs(fmt::format("{}: grain {} of '{}' is {:.4g} m wide, but not in scene.toml beside it",
                                    trajectory, frame.id[i], species.name, diameter));
    }
    for (std::size_t s = 0; s < count.size(); ++s)
        if (count[s] > scene.species[s].count && !world.traffic)  // there are fewer when some have left
            of_two_runs(fmt::format("{}: has {} of '{}', but scene.toml beside it has {}", trajectory,
                                    counted(count[s], "grain"), scene.species[s].name,
                                    scene.species[s].count));
}

void check_drive(const Scene& scene, const Clock& clock, const State& moment, const std::string& frame) {
    check_times(scene, clock.step, static_cast<double>(moment.step), moment.time, moment.cycles, frame);
    const double turns = moment.phase - moment.cycles - clock.initial_phase;
    if (scene.drive.present && std::abs(turns - std::round(turns)) > same_time)
        of_two_runs(
            fmt::format("{} is at phase {:.4g} after {:.6g} periods, but the drive of scene.toml beside "
                        "it begins at phase {:.4g}",
                        frame, moment.phase, moment.cycles, scene.drive.phase));
    if (clock.step <= 0) return;
    const DrivePose drive = DriveMotion(scene.drive, clock).at(moment.step);
    const bool all_moves = scene.drive.moves == Drive::Moves::container;
    check_own_poses(scene, drive, moment, frame);
    if (scene.container.turn) return;
    check_pose(scene.drive, moment.floor(), drive, frame + " has the floor");
    check_pose(scene.drive, moment.container(), all_moves ? drive : DrivePose(),
               frame + " has the container");
}

namespace {

// A row whose step is also in the trajectory: number of the row and of the frame.
struct Pair {
    std::size_t row, frame;
};
std::vector<Pair> moments_of_both(const std::vector<double>& steps, const std::vector<State>& moments) {
    std::vector<Pair> pairs;
    for (std::size_t row = steps.size(); row-- > 0;) {
        const auto moment = std::lower_bound(
            moments.begin(), moments.end(), steps[row],
            [](const State& one, double step) { return static_cast<double>(one.step) < step; });
        if (moment != moments.end() && static_cast<double>(moment->step) == steps[row])
            pairs.push_back({row, static_cast<std::size_t>(moment - moments.begin())});
    }
    return pairs;
}

double mean_height(const State& frame, std::size_t species) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (static_cast<std::size_t>(frame.species[i]) == species) sum += frame.position[i].z(), ++count;
    return sum / count;
}

void check_heights(const Scene& scene, const MeasureTable& table, std::size_t row, const State& frame,
                   const std::string& measures) {
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        const auto column = table.find(scene.species[s].name + "_centre_z_m");
        if (!column) continue;
        const double kept = table.values(*column, row, row + 1).front(), now = mean_height(frame, s);
        if (std::abs(kept - now) > same_place * (scene.species[s].diameter.largest + std::abs(now)))
            of_two_runs(
                fmt::format("{}: has the centre of '{}' at a height of {:.6g} m at {:.6g} s, but in "
                            "trajectory.nc beside it it is at {:.6g} m",
                            measures, scene.species[s].name, kept, frame.time, now));
    }
}

// Checks that the steps of rows rise and that each row has the time of its step.
void check_rows(double step_length, const std::vector<double>& steps, const std::vector<double>& times,
                const std::string& measures) {
    for (std::size_t row = 0; row < steps.size(); ++row) {
        const std::string line = fmt::format("{}:{}: ", measures, row + 2);
        if (row > 0 && !(steps[row] > steps[row - 1]))
            throw UserError("{}is of step {}, but the row before is of step {}; the file was altered", line,
                            steps[row], steps[row - 1]);
        if (std::abs(times[row] - steps[row] * step_length) > same_time * std::abs(times[row]))
            throw UserError(
                "{}has {:.6g} s at step {}, but a step of this run is {:.6g} s; the file was altered", line,
                times[row], steps[row], step_length);
    }
}

}  // namespace

void check_measures_at(const Scene& scene, const MeasureTable& table, const State& frame,
                       const std::string& measures) {
    const std::vector<double> steps = table.all("step");
    const auto row_of_step = std::lower_bound(steps.begin(), steps.end(), static_cast<double>(frame.step));
    if (row_of_step == steps.end() || *row_of_step != static_cast<double>(frame.step)) return;
    const auto row = static_cast<std::size_t>(row_of_step - steps.begin());
    check_heights(scene, table, row, frame, fmt::format("{}:{}", measures, row + 2));
}

void check_measures(const Scene& scene, const Clock& clock, const MeasureTable& table,
                    const StateArchive& trajectory, const std::string& measures) {
    const std::vector<double> steps = table.all("step"), times = table.all("time_s"),
                              cycles = table.all("cycles");
    if (steps.empty() || times.empty() || cycles.empty()) return;
    if (clock.step > 0) {
        check_times(scene, clock.step, steps.back(), times.back(), cycles.back(),
                    measures + ": its last row");
        check_rows(clock.step, steps, times, measures);
    }
    // One moment that both have is enough: the latest one that is not damaged.
    for (const auto& [row, index] : moments_of_both(steps, trajectory.moments())) {
        try {
            return check_heights(scene, table, row, trajectory.grains(index), measures);
        } catch (const DamagedFrame&) {
            continue;  // the damage is reported when the frame is drawn
        }
    }
}

void check_contacts(const Scene& scene, const std::vector<Link>& touches, const State& frame,
                    const std::string& contacts) {
    // Largest distance of two centres that still counts as touching, divided by the sum of the radii. In a
    // contact it is less than 1.
    constexpr double room = 1.05;
    const double depth = scene.container.periodic_depth ? scene.container.depth : 0;
    const auto index_of = [&](std::int32_t id) { return frame.row_of(id); };
    const auto apart = [&](std::size_t a, std::size_t b) {
        Vec3 way = frame.position[b] - frame.position[a];
        way.x() = nearest_image(way.x(), depth);
        return way.norm() > room * (frame.radius[a] + frame.radius[b]);
    };
    for (const Link& touch : touches) {
        const auto first = index_of(touch.first);
        const auto second = touch.second < 0 ? first : index_of(touch.second);  // it is a wall
        if (first && second && (touch.second < 0 || !apart(*first, *second))) continue;
        of_two_runs(
            fmt::format("{}: has grains {} and {} push each other at {:.6g} s, but in trajectory.nc "
                        "beside it they do not touch",
                        contacts, touch.first, touch.second, frame.time));
    }
}

}  // namespace grainreel
