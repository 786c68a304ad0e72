// How the grains of a simulation come to be where the drive finds them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measure/energy/energy.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/run/simulation/simulation_impl.hpp"
#include "engine/start/held_histories.hpp"
#include "engine/start/latches.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/start/rain.hpp"
#include "engine/start/relax.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/settle.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel {

namespace {

double solid_fraction(const Container& container, const Grains& grains) {
    std::vector<double> heights;
    for (const Place& p : grains.place) heights.push_back(p.position.z());
    if (container.shape == Container::Shape::none || grains.size() == 0) return 0;
    const double top = std::clamp(bed_height(heights), container.base(), container.height);
    double solid = 0;
    for (const Place& p : grains.place) {
        if (p.position.z() <= top) solid += 4.0 / 3.0 * std::numbers::pi * std::pow(p.radius, 3);
    }
    return top > container.base() ? solid / container.volume_below(top) : 0;
}

}  // namespace

// Those of a file or a list, where they are.
void Simulation::Impl::take_grains() {
    const bool from_checkpoint = scene.start.method == Start::Method::file && is_checkpoint(scene.start.file);
    if (from_checkpoint && scene.start.keep_clock) return go_on();
    grains = scene.start.method == Start::Method::grains ? listed_grains(scene)
             : from_checkpoint                           ? grains_from_checkpoint(scene)
                                                         : grains_from_table(scene);
    check_grains_possible(scene, grains);
    check_grains_numbered(scene, grains);
    check_grains_match(scene, grains);
    check_grains_fit(scene, around, grains);
    begin_with_taken();
    check_grains_clear(scene, around, grains, *loop);
}

// Where the checkpoint's contacts follow the same law here, with their histories. Latches of the others are
// set where the bed rests.
void Simulation::Impl::begin_with_taken() {
    set_orientations();
    make_loop();
    loop->restart();
    if (grains.size() == 0) return;
    std::optional<StartOrigin> origin;
    if (plan.start.keeps_histories) origin = origin_of(scene.start.file);
    if (origin && !any_act_alike(plan, origin->plan)) origin.reset();
    if (origin) take_histories(scene, plan, around, *origin, grains, *loop);
    const auto is_fresh = [&](const PairPlan& pair) {
        return !origin || !acts_alike_in(origin->plan, plan, pair);
    };
    if (plan.start.relaxes) set_latches(plan, around, grains, is_fresh, *loop);
}

// Where the file's bed turns out not to rest in this scene, it starts as it is in the file.
SettleReport Simulation::Impl::relax_taken(const std::function<bool(double, std::int64_t)>& watcher) {
    const Grains before = grains;
    SettleReport report = relax(scene, plan, around, grains, *loop, watcher);
    if (report.settled || !report.finished) return report;
    grains = before;
    begin_with_taken();
    return report;
}

// They decide nothing: a run may begin or cease to keep them when it goes on.
void Simulation::Impl::set_orientations() {
    if (!orientations)
        grains.orientation.clear();
    else if (grains.orientation.empty())
        grains.orientation.assign(grains.size(), Quaternion::Identity());
}

bool Simulation::Impl::pack_layers(const PackingWatcher& watcher, PackingProgress& progress) {
    grains = place_in_layers(scene);
    set_orientations();
    if (grains.size() == 0) {  // all that there will be are fed
        make_loop();
        loop->restart();
        return true;
    }
    const GrowthReport growth =
        grow_radii(scene, plan, around, grains, team, [&](double done, std::int64_t steps) {
            progress.done = done;
            progress.steps = steps;
            return watcher(progress);
        });
    make_loop();
    loop->restart();
    return growth.finished;
}

bool Simulation::Impl::pack_rain(const PackingWatcher& watcher, PackingProgress& progress) {
    progress.stage = PackingProgress::Stage::raining;
    grains = {};
    make_loop();
    loop->restart();
    const RainReport report = rain(scene, plan, around, grains, *loop, [&](double done, std::int64_t steps) {
        progress.done = done;
        progress.steps = steps;
        return watcher(progress);
    });
    set_orientations();
    return report.finished;
}

// Work and balance count from here; the forces belong to the state, so that the first half kick is right.
void Simulation::Impl::begin_drive() {
    std::fill(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
    loop->begin_account();
    start_energy = total_energy(around, grains, *loop, 0);
    if (std::isnan(start_energy)) start_energy = 0;  // a caller's law does not know it, now and ever
    step = 0;
    if (observers.need_wall_sums()) loop->tally_walls(wall_scale(scene, plan), step);
    open_when_due();
    observers.start(moment(), contacts());
}

PackingResult Simulation::pack() {
    return pack([](const PackingProgress&) { return true; });
}

PackingResult Simulation::pack(const PackingWatcher& watcher) {
    Impl& m = *impl_;
    PackingResult result;
    PackingProgress progress;
    progress.stage = PackingProgress::Stage::growing;
    if (m.continued) return result;
    if (m.scene.start.method == Start::Method::layers) result.finished = m.pack_layers(watcher, progress);
    if (m.scene.start.method == Start::Method::rain) result.finished = m.pack_rain(watcher, progress);
    if (result.finished) {
        progress.stage = PackingProgress::Stage::settling;
        const auto watch = [&](double done, std::int64_t steps) {
            progress.done = done;
            progress.steps = steps;
            return watcher(progress);
        };
        // From here, for a law may act over a step with another force than it has at its end.
        if (m.observers.need_wall_sums()) m.loop->tally_walls(wall_scale(m.scene, m.plan), -1);
        const SettleReport settled = m.plan.start.relaxes
                                         ? m.relax_taken(watch)
                                         : settle(m.scene, m.plan, m.around, m.grains, *m.loop, watch);
        result.finished = settled.finished;
        result.settled = settled.settled;
        result.settle_time = static_cast<double>(settled.steps) * m.plan.clock.step;
        result.kinetic_per_grain = settled.kinetic_per_grain;
    }
    result.solid_fraction = solid_fraction(m.scene.container, m.grains);
    m.begin_drive();
    return result;
}

}  // namespace grainreel
