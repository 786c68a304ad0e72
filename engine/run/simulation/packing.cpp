// Puts the grains of a simulation where the drive starts with them: from a file, a list, or a packing.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/system/program.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/simulation/simulated_bed_impl.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/held_histories.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/start/rain.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/settle.hpp"
#include "engine/start/start_file.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

namespace {

double solid_fraction(const Container& container, const Grains& grains) {
    std::vector<double> heights;
    for (const Place& p : grains.place) heights.push_back(p.position.z());
    if (container.shape == Container::Shape::none || grains.size() == 0) return 0;
    const double top = std::clamp(bed_height(heights), container.base(), container.height);
    double solid = 0;
    for (const Place& p : grains.place) {
        if (p.position.z() <= top) solid += 4.0 / 3.0 * std::numbers::pi * math::cube(p.radius);
    }
    return top > container.base() ? solid / container.volume_below(top) : 0;
}

}  // namespace

// Takes the grains of a file or a list at their places.
void SimulatedBed::Impl::take_grains() {
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

// Begins with the grains that were taken. Contacts of a checkpoint that follow the same law here keep their
// histories. The others get latches (largest overlaps, held_histories.hpp) with which the bed rests.
void SimulatedBed::Impl::begin_with_taken() {
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

// Relaxes the bed of a file. If it turns out not to rest in this scene, it starts as it is in the file.
SettleReport SimulatedBed::Impl::relax_taken(const std::function<bool(double, std::int64_t)>& watcher) {
    const Grains before = grains;
    SettleReport report = relax(scene, plan, around, grains, *loop, watcher);
    if (report.settled || !report.finished) return report;
    grains = before;
    begin_with_taken();
    return report;
}

// Orientations do not act on the run, so a run may begin or cease to keep them when it goes on.
void SimulatedBed::Impl::set_orientations() {
    if (!orientations)
        grains.orientation.clear();
    else if (grains.orientation.empty())
        grains.orientation.assign(grains.size(), Quaternion::Identity());
}

bool SimulatedBed::Impl::pack_layers(const PackingWatcher& watcher, PackingProgress& progress) {
    grains = place_in_layers(scene);
    set_orientations();
    if (grains.size() == 0) {  // all grains will come from feeds
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

bool SimulatedBed::Impl::pack_rain(const PackingWatcher& watcher, PackingProgress& progress) {
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

// Begins the account of work and energy. The forces are computed for the present state, so that the first
// half step of the velocities is right.
void SimulatedBed::Impl::begin_drive() {
    std::fill(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
    loop->begin_account();
    start_energy = total_energy(around, grains, *loop, 0);
    if (std::isnan(start_energy)) start_energy = 0;  // a caller's own contact law tells no energy
    step = 0;
    if (observers.need_wall_sums()) loop->tally_walls(wall_scale(scene, plan), step);
    open_exits();
    open_when_due();
}

void SimulatedBed::Impl::open_exits() {
    for (const Exit& exit : std::exchange(shut_exits, {})) around.exits.push_back(exit);
}

// Lets the grains leave that lie in an exit when the drive starts, and begins to measure.
void SimulatedBed::Impl::start_observers() {
    const auto volume = [](double radius) { return math::cube(radius); };
    double stays = 0, leaves = 0;
    loop->let_leave(step);
    for (const Place& p : grains.place) stays += volume(p.radius);
    for (const Departure& one : loop->departures()) leaves += volume(one.radius);
    packed.left = loop->departures().size();
    packed.left_share = leaves > 0 ? leaves / (stays + leaves) : 0;
    ObservedState first = moment();
    first.left_at_start = loop->departures();
    observers.start(first, contacts());
}

PackingResult SimulatedBed::pack() {
    return pack([](const PackingProgress&) { return true; });
}

PackingResult SimulatedBed::pack(const PackingWatcher& watcher, const WhenPacked& when_packed) {
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
        // The tally begins here, because a law may act over a step with another force than it has at the
        // step's end.
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
    if (when_packed && result.finished) when_packed(result);
    m.start_observers();
    result.left = m.packed.left;
    result.left_share = m.packed.left_share;
    return result;
}

// Kept packings, and runs that begin with one instead of packing by themselves.

namespace {

constexpr int kFormat = 2;  // version of keys and files; to be raised if either changes

// All numbers of a contact that act on a packing. A number that PairPlan gets for a law must be added here,
// or a packing of other contacts could be taken from the cache.
std::string text_of(const PairPlan& p) {
    std::string text = fmt::format(
        "{} {} {} {} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {}",
        static_cast<int>(p.model.normal), static_cast<int>(p.model.tangential), p.model.rolls,
        static_cast<int>(p.model.precision), p.effective_mass, p.loading_stiffness, p.unloading_stiffness,
        p.hardening, p.modulus, p.tangential_stiffness, p.tangential_ratio, p.gamma, p.restitution,
        p.friction, p.rolling_friction, p.normal_damping, p.tangential_damping, p.damping_by_root,
        p.tangential_damping_by_root, p.hertz_damping, p.allowed_overlap, p.attraction);
    for (const RestitutionPoint& point : p.restitution_table)
        text += fmt::format(" {:a}:{:a}", point.speed, point.restitution);
    return text + "\n";
}

std::string text_of(const Plan& plan) {
    std::string text = fmt::format(
        "arms {} integrator {} moving {} step {:a} limits {} {} histories {} relaxes {}\n",
        static_cast<int>(plan.arms), static_cast<int>(plan.integrator), plan.moving_walls, plan.clock.step,
        plan.settle_steps_limit, plan.rain_steps_limit, plan.start.keeps_histories, plan.start.relaxes);
    for (const std::vector<PairPlan>* pairs : {&plan.grain, &plan.wall, &plan.glued, &plan.mesh}) {
        text += "contacts\n";
        for (const PairPlan& pair : *pairs) text += text_of(pair);
    }
    return text;
}

bool any_own_law(const Plan& plan) {
    for (const std::vector<PairPlan>* pairs : {&plan.grain, &plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& pair : *pairs)
            if (pair.model.own != nullptr) return true;
    return false;
}

// Whether the packing depends on the drive. Growing radii begin at step 0, so the drive's first steps act on
// them. All other packing comes before step 0, when the driven parts stand still. Only the last force of a
// bed that does not settle belongs to step 0.
bool sees_drive(const Scene& scene) {
    return scene.start.method == Start::Method::layers;
}

std::string text_of(const Drive& drive, const DrivePose& at_begin) {
    const auto numbers = [](const Vec3& v) { return fmt::format("{:a} {:a} {:a}", v.x(), v.y(), v.z()); };
    return fmt::format("drive {} {} {} {}\n", drive.present, static_cast<int>(drive.moves),
                       numbers(at_begin.offset), numbers(at_begin.velocity));
}

// The part of a scene on which the packing depends, without film, output and duration.
Scene packed_part(const Scene& scene, const Plan& plan) {
    Scene part = with_choices(scene, plan);
    part.title.clear();
    part.film_text.clear();
    part.output = {};
    part.wishes = {};
    part.run.duration = 1;
    part.run.threads = 0;
    for (Species& species : part.species) species.colour_text.clear();
    if (scene.start.method == Start::Method::file) part.start.file = hash_of_file(scene.start.file);
    if (!sees_drive(scene)) part.drive = {};
    return naming_kept_files(std::move(part));
}

bool is_possible(const PackingResult& result) {
    return std::isfinite(result.settle_time) && std::isfinite(result.kinetic_per_grain) &&
           std::isfinite(result.solid_fraction);
}

}  // namespace

std::string SimulatedBed::packing_key() const {
    const Impl& m = *impl_;
    const std::string build = build_identity();
    const bool packs = m.scene.start.packs() ? m.scene.grains_at_start() > 0 : m.plan.start.relaxes;
    if (m.continued || !packs || build.empty() || any_own_law(m.plan)) return "";
    std::string key = fmt::format("packing {} of build {} with {}\n", kFormat, build, vector_instructions());
    key += fmt::format("orientations {} wall sums {}\n", m.orientations, m.observers.need_wall_sums());
    key += fmt::format("period {}\n", sees_drive(m.scene) ? m.plan.clock.steps_per_period : 0);
    key += text_of(m.scene.drive, m.around.motion.at(0)) + text_of(m.plan);
    return key + written_scene(packed_part(m.scene, m.plan));
}

void SimulatedBed::save_packing(const std::filesystem::path& file, const std::string& key,
                                const PackingResult& result) const {
    const Impl& m = *impl_;
    GRAINREEL_CHECK(m.loop->traffic().left == 0);
    grainreel::save_checkpoint(file, key, m.header(), m.grains, *m.loop, m.gathered_of_packing(result),
                               m.feeder.given());
}

std::optional<SimulatedBed> SimulatedBed::with_packing(const Scene& scene, const Plan& plan,
                                                       const std::filesystem::path& file,
                                                       const std::string& key, int threads,
                                                       PackingResult& result) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(file);
    if (!label || label->scene != key || label->step != 0) return std::nullopt;
    try {
        auto impl = std::make_unique<Impl>(continued(scene, file), plan, threads, Impl::Takes::packing);
        result = impl->packed;
        return SimulatedBed(std::move(impl));
    } catch (const UserError&) {
        return std::nullopt;
    }
}

// Takes what a kept packing holds besides the state. Observers gather from the start of the drive, so nothing
// of theirs is kept except the last forces on walls.
void SimulatedBed::Impl::begin_packed(const std::string& gathered) {
    Bytes in(gathered);
    take_wall_sums(in);
    std::uint8_t settled = 0;
    read_value(in, settled);
    read_value(in, packed.settle_time);
    read_value(in, packed.kinetic_per_grain);
    read_value(in, packed.solid_fraction);
    packed.settled = settled == 1;
    if (in.failed() || in.left() > 0 || settled > 1 || !is_possible(packed)) throw damaged_checkpoint(scene);
}

std::string SimulatedBed::Impl::gathered_of_packing(const PackingResult& result) const {
    std::ostringstream out;
    save_wall_sums(out);
    write_value(out, static_cast<std::uint8_t>(result.settled ? 1 : 0));
    write_value(out, result.settle_time);
    write_value(out, result.kinetic_per_grain);
    write_value(out, result.solid_fraction);
    return out.str();
}

}  // namespace grainreel
