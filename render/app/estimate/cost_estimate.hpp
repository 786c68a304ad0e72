// Estimates, before a run begins, what it will take on this machine, in time and on disk. The cost of a frame
// is found by a short trial film, once for each look of a film; the cache keeps it.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"
#include "render/app/estimate/speed_cache.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The speed of this machine, measured now or kept from an earlier time.
struct MachineFigures {
    double lattice_one = 0;      // grain-steps a second of lattice_speed() on one thread
    double lattice_team = 0;     // the same on the engine's threads
    double frame_seconds = 0;    // s of processor time to draw and encode a frame of one moment
    double frame_drawing = 0.5;  // share of drawing in frame_seconds
    int processors = 1;          // processors that the program may use
    double gain_of_two = 2;      // speed of two threads divided by that of one, from 1 to 2
};

struct CostEstimate {
    double grain_steps = 0;                          // of packing and run
    double packing_share = 0;                        // the share of packing in grain_steps
    double engine_one = 0;                           // grain-steps a second of one thread, in this scene
    double packing_seconds = 0, engine_seconds = 0;  // on the planned threads
    std::int64_t frames = 0;
    double frame_seconds = 0;  // s of processor time of a mean frame, with all its exposures
    double film_seconds = 0;
    double total_seconds = 0;
};

// On one or two processors the engine waits while pictures are made; on more it works beside the film
// (ThreadPlan in render/film/sources/film_request.hpp).
CostEstimate estimate_cost(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                           const ThreadPlan& threads, const MachineFigures& machine);

// Takes the figures from the cache, or measures them now and keeps them there. Measuring takes about half a
// second, and as much again for a film with a new look. film: false leaves out the cost of frames.
MachineFigures machine_figures(const FilmedScene& scene, const Plan& plan, const ThreadPlan& threads,
                               bool film = true);

// What a run will leave on disk.
struct DiskEstimate {
    std::int64_t trajectory_frames = 0, measures_rows = 0;
    double trajectory = 0, measures = 0, film = 0;  // bytes
    double film_moments = 0, checkpoints = 0;       // bytes
    double end_state = 0;                           // bytes of checkpoint and final.csv

    double all() const { return trajectory + measures + film + film_moments + checkpoints + end_state; }
};

// pictures: number of the film's pictures; 0 without a film.
DiskEstimate estimate_disk(const FilmedScene& scene, const Plan& plan, std::int64_t pictures);

// s that a film takes in addition to its frames: for the OpenGL context, the first frame, and poster.png.
constexpr double film_setup_seconds = 0.2;

// Measures how fast the scene's film is made: draws and encodes some frames of its grains, stacked as the bed
// will lie, in a folder that is removed afterwards. None when that is not possible here (no OpenGL, no codec,
// no room), and for beds of more than 200,000 grains.
std::optional<FilmSpeed> probe_film(const FilmedScene& scene, const ThreadPlan& threads);

// The scene's grains in a stack from the floor up, as loose as a shaken bed. Exposed for tests.
State stacked_bed(const FilmedScene& scene);

}  // namespace grainreel
