#include "render/app/estimate/cost_estimate.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <functional>

#include "engine/base/team.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "render/app/estimate/engine_cost.hpp"
#include "render/app/estimate/film_probe.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// Two threads gain half of what they could with so many grains: they wait for each other once a step.
constexpr double grains_of_half_gain = 1000;
constexpr double seconds_to_start = 0.1;
// Where no frame can be drawn for a measurement: s a million pixels.
constexpr double assumed_seconds = 0.02;

// Drawing and encoding have a thread each, and more where there are processors for them. Two threads are not
// twice as fast as one where their processors share a core, or the caches.
double film_wall(double processor_seconds, double drawing, const ThreadPlan& threads,
                 const MachineFigures& machine, int processors) {
    if (processors < 2) return processor_seconds;
    const double drawn = drawing / threads.raster, encoded = (1 - drawing) / threads.encoder;
    const double at_once = std::min(threads.raster + threads.encoder, processors);
    const double gain = 1 + (machine.gain_of_two - 1) * (at_once - 1);
    return processor_seconds * std::min(1.0, std::max({drawn, encoded, 1 / gain}));
}

double film_processor_seconds(const std::vector<SegmentCount>& film, const MachineFigures& machine) {
    double pictures = 0;
    for (const SegmentCount& segment : film) {
        const auto shots = static_cast<double>(segment.shots);
        const double moments = 1 + static_cast<double>(segment.exposures_a_shot);
        pictures += shots * (1 - machine.frame_drawing + machine.frame_drawing * moments);
    }
    return pictures * machine.frame_seconds;
}

// What the picture depends on, and no more of the scene than can be helped.
std::string look_of(const FilmedScene& scene, const Plan& plan, const ThreadPlan& threads) {
    FilmedScene look = scene;
    look.run = Run();
    look.output = Output();
    return fmt::format("{:016x}-{}-{}", std::hash<std::string>()(resolved_scene(look, plan)), threads.raster,
                       threads.encoder);
}

}  // namespace

CostEstimate estimate_cost(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                           const ThreadPlan& threads, const MachineFigures& machine) {
    CostEstimate cost;
    const EngineCost engine = engine_cost(scene, plan);
    const auto grains = static_cast<double>(scene.grains());
    cost.grain_steps = grains * (engine.run_steps + engine.packing_steps);
    cost.packing_share = engine.packing_steps / (engine.run_steps + engine.packing_steps);
    cost.engine_one = machine.lattice_one * grains * engine.run_steps / engine.run;
    const double gain = threads.engine > 1 ? std::clamp(machine.lattice_team / machine.lattice_one, 1.0,
                                                        static_cast<double>(threads.engine))
                                           : 1.0;
    const double gained = 1 + (gain - 1) * grains / (grains + grains_of_half_gain);
    cost.packing_seconds = engine.packing / (machine.lattice_one * gained);
    cost.engine_seconds = engine.run / (machine.lattice_one * gained);
    for (const SegmentCount& segment : film) cost.frames += segment.shots;
    double film_seconds = 0;
    if (cost.frames > 0) {
        const double used = film_processor_seconds(film, machine);
        // Who asks for one thread is told what one processor does.
        const int processors =
            scene.run.threads > 0 ? std::min(scene.run.threads, machine.processors) : machine.processors;
        cost.frame_seconds = used / static_cast<double>(cost.frames);
        film_seconds =
            film_wall(used, machine.frame_drawing, threads, machine, processors) + film_setup_seconds;
    }
    cost.film_seconds = film_seconds;
    cost.total_seconds = seconds_to_start + cost.packing_seconds +
                         (threads.take_turns ? cost.engine_seconds + film_seconds
                                             : std::max(cost.engine_seconds, film_seconds));
    return cost;
}

MachineFigures machine_figures(const FilmedScene& scene, const Plan& plan, const ThreadPlan& threads,
                               bool has_film) {
    SpeedCache cache;
    const auto engine = [&](int team) {
        if (const auto known = cache.engine(team)) return *known;
        cache.keep_engine(team, lattice_speed(team));
        return cache.engine(team).value_or(1e7);
    };
    MachineFigures machine;
    machine.processors = usable_processors();
    machine.lattice_one = engine(1);
    // More threads than processors would measure their waiting.
    machine.lattice_team = engine(std::min(threads.engine, machine.processors));
    if (has_film && machine.processors > 1)
        machine.gain_of_two = std::clamp(engine(2) / machine.lattice_one, 1.0, 2.0);
    if (!has_film) {
        cache.save();
        return machine;
    }
    const std::string look = look_of(scene, plan, threads);
    std::optional<FilmSpeed> film = cache.film(look);
    if (!film && (film = probe_film(scene, threads))) cache.keep_film(look, *film);
    const double pixels = 1e-6 * static_cast<double>(scene.film.width) * scene.film.height;
    machine.frame_seconds = film ? film->seconds : assumed_seconds * pixels;
    if (film) machine.frame_drawing = film->drawing;
    cache.save();
    return machine;
}

namespace {

// A grain and frame: id, type, radius, x in double, v, spin, contact number.
constexpr double trajectory_bytes = 68;
constexpr double orientation_bytes = 16;
constexpr double measures_bytes = 400;     // a row
constexpr double checkpoint_bytes = 1300;  // a grain: lists and histories
constexpr double end_state_bytes =
    1500;  // a grain: its row of final.csv, and lists and histories of the checkpoint

// every: steps from one to the next, not always a whole number.
std::int64_t moments(std::int64_t steps, double every) {
    return static_cast<std::int64_t>(static_cast<double>(steps) / every) + 1;
}

}  // namespace

DiskEstimate estimate_disk(const FilmedScene& scene, const Plan& plan, std::int64_t pictures) {
    const auto grains = static_cast<double>(scene.grains());
    DiskEstimate disk;
    if (plan.trajectory_every > 0) {
        disk.trajectory_frames = moments(plan.steps, plan.trajectory_every);
        disk.trajectory = static_cast<double>(disk.trajectory_frames) * grains *
                          (trajectory_bytes + (scene.keeps_orientations() ? orientation_bytes : 0));
    }
    disk.measures_rows = moments(plan.steps, plan.measures_every);
    disk.measures = static_cast<double>(disk.measures_rows) * measures_bytes;
    if (pictures > 0) disk.film = estimated_film_size(scene.film, pictures);
    disk.film_moments = film_moments_bytes(scene, plan, pictures);
    if (scene.output.checkpoints)
        disk.checkpoints = std::min(static_cast<double>(*scene.output.checkpoints),
                                    static_cast<double>(CheckpointRing::kMost) * grains * checkpoint_bytes);
    disk.end_state = grains * end_state_bytes;
    return disk;
}

}  // namespace grainreel
