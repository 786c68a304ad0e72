#include "render/cli/estimate/cost_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "engine/base/team.hpp"
#include "engine/bench/lattice_speed.hpp"
#include "engine/plan/rain_plan.hpp"
#include "engine/scene/text/writer.hpp"
#include "engine/start/relax.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/forces/scheme.hpp"
#include "render/cli/estimate/film_probe.hpp"
#include "render/cli/estimate/speed_cache.hpp"

namespace grainreel {
namespace {

// A step of a grain in the shipped scenes, shaken, over one of the lattice; and what a step costs besides, in
// grains. Measured by processor time (docs/notes/performance.md).
constexpr double bed_over_lattice = 0.31;
constexpr double grains_of_a_step = 20;
// Two threads gain half of what they could with so many grains: they wait for each other once a step.
constexpr double grains_of_half_gain = 1000;
// Radii grow in about so many steps, whatever their length; then the bed settles for some time, all in
// contact.
constexpr double growing_steps = 120e3, settling_time = 0.9 /* s */, settling_over_shaken = 1.6;
constexpr double large_bed = 1.5;     // does not fit into the caches
constexpr double row_over_step = 12;  // a row of measures over a step
constexpr double seconds_to_start = 0.1;
// Where no frame can be drawn for a measurement: s a million pixels.
constexpr double assumed_seconds = 0.02;

double law_cost(const PairPlan& pair) {
    double cost = 1;
    if (pair.model.normal == NormalForce::spring_dashpot) cost = 0.7;
    if (pair.model.normal == NormalForce::hertz) cost = 1.1;
    if (pair.model.tangential == TangentialLaw::none) cost *= 0.65;
    if (pair.model.rolls) cost *= 1.1;
    return pair.model.precision == Precision::mixed ? 0.85 * cost : cost;
}

// The law that most contacts follow: that of the commonest species.
double scene_cost(const Scene& scene, const Plan& plan) {
    std::size_t most = 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].all() > scene.species[most].all()) most = s;
    const auto forces = static_cast<double>(scheme_of(plan.integrator).stages.size());
    const double size = static_cast<std::size_t>(scene.grains()) > kLargeBed ? large_bed : 1;
    return law_cost(plan.between(most, most)) * forces * size;
}

// In steps of a shaken bed.
double packing_steps(const Scene& scene, const Plan& plan) {
    // A bed that relaxes is at rest soon after it was stopped.
    if (plan.start.relaxes)
        return settling_over_shaken *
               (static_cast<double>(braking_steps(plan)) + settling_time / plan.clock.step);
    if (!scene.start.packs() || scene.grains_at_start() == 0) return 0;
    const bool rains = scene.start.method == Start::Method::rain;
    const double settling = settling_time / plan.clock.step;
    // On average half of the grains are there while it rains.
    const auto raining = [&] {
        return 0.5 * static_cast<double>(scene.grains_at_start()) / rain_rate(scene) / plan.clock.step;
    };
    return (rains ? raining() : growing_steps) +
           settling_over_shaken * std::min(static_cast<double>(plan.settle_steps_limit), settling);
}

// Drawing and encoding have a thread each, and more where there are processors for them.
double film_wall(double processor_seconds, double drawing, const ThreadPlan& threads, int processors) {
    if (processors < 2) return processor_seconds;
    const double drawn = drawing / threads.raster, encoded = (1 - drawing) / threads.encoder;
    return processor_seconds * std::min(1.0, std::max(drawn, encoded));
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
std::string look_of(const Scene& scene, const Plan& plan, const ThreadPlan& threads) {
    Scene look = scene;
    look.run = Run();
    look.output = Output();
    return fmt::format("{:016x}-{}-{}", std::hash<std::string>()(resolved_scene(look, plan)), threads.raster,
                       threads.encoder);
}

}  // namespace

CostEstimate estimate_cost(const Scene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                           const ThreadPlan& threads, const MachineFigures& machine) {
    CostEstimate cost;
    const auto grains = static_cast<double>(scene.grains());
    const double packing = packing_steps(scene, plan), steps = static_cast<double>(plan.steps);
    cost.grain_steps = grains * (steps + packing);
    cost.packing_share = packing / (steps + packing);
    cost.engine_one = machine.lattice_one / (bed_over_lattice * scene_cost(scene, plan));
    const double gain = threads.engine > 1 ? std::clamp(machine.lattice_team / machine.lattice_one, 1.0,
                                                        static_cast<double>(threads.engine))
                                           : 1.0;
    const double gained = 1 + (gain - 1) * grains / (grains + grains_of_half_gain);
    const double step_seconds = (grains + grains_of_a_step) / (cost.engine_one * gained);
    cost.packing_seconds = packing * step_seconds;
    cost.engine_seconds =
        steps * step_seconds + steps / plan.measures_every * row_over_step * grains / cost.engine_one;
    for (const SegmentCount& segment : film) cost.frames += segment.shots;
    double film_seconds = 0;
    if (cost.frames > 0) {
        const double used = film_processor_seconds(film, machine);
        cost.frame_seconds = used / static_cast<double>(cost.frames);
        film_seconds =
            film_wall(used, machine.frame_drawing, threads, machine.processors) + film_setup_seconds;
    }
    cost.film_seconds = film_seconds;
    cost.total_seconds = seconds_to_start + cost.packing_seconds +
                         (threads.take_turns ? cost.engine_seconds + film_seconds
                                             : std::max(cost.engine_seconds, film_seconds));
    return cost;
}

MachineFigures machine_figures(const Scene& scene, const Plan& plan, const ThreadPlan& threads,
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

}  // namespace grainreel
