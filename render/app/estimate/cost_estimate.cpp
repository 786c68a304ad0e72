#include "render/app/estimate/cost_estimate.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/base/team.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/mesh/room.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/scene/bed.hpp"
#include "render/app/estimate/engine_cost.hpp"
#include "render/app/estimate/speed_cache.hpp"
#include "render/app/messages/stop_signal.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// With this many grains several threads gain half of what they gain in a large bed, because they wait for
// each other in each step.
constexpr double grains_of_half_gain = 1000;
constexpr double seconds_to_start = 0.1;
// s for a million pixels, used when no frame can be drawn for a measurement.
constexpr double assumed_seconds = 0.02;

// The wall time of a film in s. processor_seconds: its processor time; drawing: the share of drawing in that.
// Drawing and encoding have a thread each, and more if there are processors for them. Two threads are not
// twice as fast as one if their processors share a core or the caches.
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

// A key for the cache: a hash of everything in the scene on which the cost of a picture depends, and of as
// little else as possible; and the numbers of threads.
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
        // A run on one thread gets the estimate for one processor.
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

// Bytes for each grain and frame: id, type, radius, position in double, velocity, spin, number of contacts.
constexpr double trajectory_bytes = 68;
constexpr double orientation_bytes = 16;
constexpr double measures_bytes = 400;     // bytes of a row
constexpr double checkpoint_bytes = 1300;  // bytes of a grain: lists and histories
constexpr double end_state_bytes =
    1500;  // bytes of a grain: its row in final.csv, and lists and histories in the checkpoint

// Number of moments. every: steps from one to the next, not always a whole number.
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

namespace {

namespace fs = std::filesystem;

constexpr int most_drawn = 32, least_drawn = 4;
constexpr double patience = 0.6;  // s after which no further frame is begun
constexpr std::int64_t most_grains = 200'000;
constexpr double shaken_fraction = 0.5;  // solid fraction of a shaken bed
// The time for a frame of a run, divided by that for a frame of the stack, in which more grains are visible.
// It is 0.7 to 0.9 for the scenes that come with the program.
constexpr double run_over_stack = 0.8;

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void add_grain(State& frame, std::size_t species, double radius, const Vec3& position) {
    frame.id.push_back(static_cast<std::int32_t>(frame.size()));
    frame.species.push_back(static_cast<std::int32_t>(species));
    frame.radius.push_back(radius);
    frame.position.push_back(position);
    frame.velocity.push_back(Vec3::Zero());
    frame.spin.push_back(Vec3::Zero());
}

// An order of the grains' species in which all species are spread over the bed.
std::vector<std::size_t> spread_species(const FilmedScene& scene) {
    std::vector<std::size_t> all;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        all.insert(all.end(), static_cast<std::size_t>(scene.species[s].all()), s);
    Random random(1, Stream::centres);
    for (std::size_t i = all.size(); i > 1; --i)
        std::swap(
            all[i - 1],
            all[std::min(i - 1, static_cast<std::size_t>(random.between(0, 1) * static_cast<double>(i)))]);
    return all;
}

// Moves the bed about as far as it moves between two frames in slow motion: all grains together, and each a
// little by itself.
ShotPtr shaken(const State& bed, int k, Random& random) {
    Shot frame = bed;
    frame.step = k;
    frame.time = 0.01 * k;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const double reach = 0.01 * frame.radius[i];
        frame.velocity[i] = 10 * random.in_cube(reach);
        frame.position[i] += random.in_cube(reach) + Vec3(0, 0, 0.3 * frame.radius[0] * (k % 4));
    }
    return std::make_shared<const Shot>(std::move(frame));
}

struct FilmUse {
    int frames = 0;
    double seconds = 0;  // seconds of processor time
    double drawing = 0;  // share of drawing in that time
};

// Processor time of a film of `most` frames, or of fewer when they take long.
FilmUse use_of_film(const FilmedScene& scene, const ThreadPlan& threads, const State& bed, int most,
                    const HeldSignals& signals) {
    const ScratchFolder folder("check");
    FilmOptions options;
    options.folder = folder.path();
    options.raster_threads = threads.raster;
    options.encoder_threads = threads.encoder;
    options.pictures = most;
    Random random(2, Stream::centres);
    const Stopwatch watch;
    const double before = processor_seconds();
    FilmMaker film(scene, options);
    FilmUse use;
    const auto goes_on = [&] {
        if (signals.waiting()) return false;
        return use.frames < most && (use.frames < least_drawn || watch.seconds() < patience);
    };
    for (; goes_on(); ++use.frames) film.take(shaken(bed, use.frames, random), "");
    const FilmResult result = film.finish();
    const double busy = result.draw_seconds + result.encode_seconds;
    use.seconds = processor_seconds() - before;
    use.drawing = busy > 0 ? result.draw_seconds / busy : 0.5;
    return use;
}

}  // namespace

namespace {

// Stacks grains in a box from the bottom upwards, as many as fit.
State stacked_in(const FilmedScene& scene, const std::vector<std::size_t>& species, double pitch,
                 const Region& box) {
    State frame;
    for (double z = box.low.z() + pitch / 2; z < box.high.z(); z += pitch)
        for (double x = box.low.x() + pitch / 2; x < box.high.x(); x += pitch)
            for (double y = box.low.y() + pitch / 2; y < box.high.y(); y += pitch) {
                if (frame.size() == species.size()) return frame;
                const std::size_t of = species[frame.size()];
                add_grain(frame, of, scene.species[of].diameter.mean / 2, Vec3(x, y, z));
            }
    return frame;
}

}  // namespace

State stacked_bed(const FilmedScene& scene) {
    State frame;
    if (scene.start.method == Start::Method::grains) {
        for (const ListedGrain& grain : scene.start.grains)
            add_grain(frame, grain.species, grain.diameter / 2, grain.position);
        return frame;
    }
    if (scene.grains() == 0) return frame;
    const Container& c = scene.container;
    const std::vector<std::size_t> species = spread_species(scene);
    const double pitch =
        std::cbrt(solid_volume(scene) / static_cast<double>(species.size()) / shaken_fraction);
    const double most = pitch * static_cast<double>(species.size());  // m, length of a row of all grains
    if (const auto& region = scene.start.region) return stacked_in(scene, species, pitch, *region);
    const bool vessel = c.shape == Container::Shape::mesh;
    const double widest = std::min(most, c.shape == Container::Shape::cylinder ? c.half_width : c.depth / 2);
    const double high = std::min(most, c.height - c.base()) + c.base();
    for (double z = c.base() + pitch / 2; z < high && frame.size() < species.size(); z += pitch) {
        const double wide = std::min(most, c.half_width_at(z));
        const double deep = vessel ? std::min(most, c.room->half_depth_at(z)) : widest;
        for (double x = -deep + pitch / 2; x < deep && frame.size() < species.size(); x += pitch)
            for (double y = -wide + pitch / 2; y < wide && frame.size() < species.size(); y += pitch) {
                if (c.shape == Container::Shape::cylinder && x * x + y * y > wide * wide) continue;
                const std::size_t of = species[frame.size()];
                add_grain(frame, of, scene.species[of].diameter.mean / 2, Vec3(x, y, z));
            }
    }
    return frame;
}

std::optional<FilmSpeed> probe_film(const FilmedScene& scene, const ThreadPlan& threads) {
    if (scene.grains() > most_grains) return std::nullopt;
    const HeldSignals signals;  // signals wait until the film's folder is removed
    try {
        const State bed = stacked_bed(scene);
        // The first film of the process loads libraries and fonts, so it is not counted.
        use_of_film(scene, threads, bed, 1, signals);
        // The time that a film takes before its frames is in both films, so it is not in their difference.
        const FilmUse setup = use_of_film(scene, threads, bed, 1, signals);
        const FilmUse film = use_of_film(scene, threads, bed, most_drawn, signals);
        if (film.frames < least_drawn) return std::nullopt;
        const double frames = std::max(0.2 * film.seconds, film.seconds - setup.seconds);
        return FilmSpeed{run_over_stack * frames / (film.frames - 1), film.drawing};
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace grainreel
