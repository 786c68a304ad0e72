// The parts of a simulation, for the files that implement it: simulation.cpp (steps, feeds and output),
// packing.cpp (packings, new or kept) and going_on.cpp (checkpoints). No other file includes this.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/measure/health.hpp"
#include "engine/measure/observers.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/settle.hpp"
#include "engine/state/body.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// The scene's feeds at work: which grains come, and when.
//
// Feeds look for places only once in a number of steps, so that lists are not made anew more often. A grain
// comes at the first look after it is due. A grain that finds no place waits for the next look, and the
// grains behind it wait too.
class Feeder {
  public:
    // The scene and the surroundings must outlive it.
    Feeder(const Scene& scene, const Plan& plan, const Surroundings& around);

    // The first step after this one at which to look; far away if there are no feeds.
    std::int64_t next_look(std::int64_t step) const;

    // The grains that come at a step at which feeds look. Throws RunError if grains have waited too long,
    // because the place is full.
    std::vector<ComingGrain> take(std::int64_t step, const Grains& grains);

    // Number of grains that each feed has given. Checkpoints save it.
    const std::vector<std::int64_t>& given() const { return given_; }
    void set_given(std::vector<std::int64_t> given) { given_ = std::move(given); }

  private:
    void check_patience(std::size_t feed, double time) const;

    const Scene& scene_;
    const Clock clock_;
    const Surroundings& around_;
    std::vector<std::int64_t> given_;  // by feed
    std::vector<bool>
        into_vessel_;  // for each feed, whether its grains come in the room of a vessel of triangles
};

struct SimulatedBed::Impl {
    // Use of a checkpoint: to go on with its run, to go on with a changed run, to replay moments of its run,
    // or as a packing from which a run begins.
    enum class Takes { same_run, changed_run, replay, packing };

    Impl(const Scene& s, const Plan& p, int threads, Takes what = Takes::same_run)
        : scene(s),
          plan(p),
          team(threads > 0 ? threads : usable_processors()),
          around(make_surroundings(s, p)),
          bodies(bodies_of(s)),
          limits(health_limits(s, p)),
          observers(all_observers(), scene, plan),
          takes(what) {
        if (!scene.start.packs()) take_grains();
    }

    Scene scene;
    Plan plan;
    Team team;
    Surroundings around;
    std::vector<Exit> shut_exits = std::exchange(around.exits, {});  // exits that do not act yet
    std::vector<Body> bodies;
    Grains grains;
    std::unique_ptr<StepLoop> loop;
    Feeder feeder{scene, plan, around};
    std::int64_t step = 0;
    double start_energy = 0;
    HealthLimits limits;
    EnergyWatch energy_watch;
    DeepestContact deepest;      // of the whole run
    std::int64_t next_look = 0;  // step

    bool continued = false;  // whether the run goes on where the file stopped
    bool opened = false;     // whether the container's outlet is open

    Observers observers;
    Takes takes = Takes::same_run;
    PackingResult packed;  // result of a packing that was taken
    bool orientations = scene.keeps_orientations();
    std::optional<WallSums> wall_sums;  // sums of the last moment, if an observer needs them

    void make_loop() { loop = std::make_unique<StepLoop>(plan, around, grains, team); }
    void take_grains();
    void begin_with_taken();
    SettleReport relax_taken(const std::function<bool(double, std::int64_t)>& watcher);
    void go_on();
    void check_not_over() const;
    void set_orientations();
    bool pack_rain(const PackingWatcher& watcher, PackingProgress& progress);
    std::int32_t insert(const std::vector<ComingGrain>& more);
    bool pack_layers(const PackingWatcher& watcher, PackingProgress& progress);
    void begin_drive();
    void start_observers();
    void open_exits();
    void open_when_due();
    void look_at_health();
    void note_overlap(DeepestContact now);
    ObservedState moment();
    void take_gathered(const std::string& bytes);
    void take_wall_sums(Bytes& in);
    void save_wall_sums(std::ostream& out) const;
    std::string gathered() const;
    void begin_packed(const std::string& gathered);
    std::string gathered_of_packing(const PackingResult& result) const;
    CheckpointHeader header() const;
    ShowContacts contacts() const;
};

}  // namespace grainreel
