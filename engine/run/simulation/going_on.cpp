// Saves a simulation and resumes it, bit by bit.
#include <xxhash.h>

#include <sstream>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/run/simulation/simulated_bed_impl.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

SimulatedBed SimulatedBed::at_checkpoint(const Scene& scene, const Plan& plan,
                                         const std::filesystem::path& checkpoint, int threads,
                                         bool may_change, bool replays) {
    const Impl::Takes what = replays      ? Impl::Takes::replay
                             : may_change ? Impl::Takes::changed_run
                                          : Impl::Takes::same_run;
    return SimulatedBed(std::make_unique<Impl>(continued(scene, checkpoint), plan, threads, what));
}

void SimulatedBed::Impl::go_on() {
    make_loop();
    std::string gathered;
    std::vector<std::int64_t> given;
    const CheckpointHeader header = continue_from_checkpoint(
        scene, plan, grains, *loop, gathered, given, takes == Takes::changed_run || takes == Takes::packing);
    feeder.set_given(std::move(given));
    if (takes == Takes::replay) orientations = !grains.orientation.empty();
    set_orientations();
    step = header.step;
    start_energy = header.start_energy;
    continued = true;
    open_exits();
    opened = plan.opens && step >= *plan.opens;
    if (opened) open_outlet(scene, around);
    if (takes == Takes::packing) {
        begin_packed(gathered);
        start_observers();
    } else {
        take_gathered(gathered);
        observers.start(moment(), contacts());
    }
}

void SimulatedBed::Impl::check_not_over() const {
    if (step >= plan.steps)
        throw UserError("{}: the start is at step {} already and the run ends at step {}; raise run.duration",
                        scene.where("run.duration"), step, plan.steps);
}

// Loads the sums of walls, and then the data of the observers. If these are missing, gathering begins here.
void SimulatedBed::Impl::take_gathered(const std::string& bytes) {
    Bytes in(bytes);
    take_wall_sums(in);
    observers.load(moment(), in);
    if (in.failed()) throw damaged_checkpoint(scene);
}

void SimulatedBed::Impl::take_wall_sums(Bytes& in) {
    WallSums sums;
    read_vector(in, sums.faces);
    read_vector(in, sums.slices);
    read_value(in, sums.scale.force);
    read_value(in, sums.scale.length);
    if (observers.need_wall_sums()) {
        WallScale scale = wall_scale(scene, plan);
        const bool there = !sums.faces.empty();
        // The plan may expect other impacts than the run's first plan did, or have other contacts. The sums
        // go on in the units in which they began.
        if (there) scale.force = sums.scale.force, scale.length = sums.scale.length;
        if (there && !is_sound(sums, around.faces.size() + around.meshes.size(), scale)) in.fail();
        if (in.failed()) throw damaged_checkpoint(scene);
        there ? loop->go_on_tallying(sums, scale) : loop->tally_walls(scale, step);
    }
}

void SimulatedBed::Impl::save_wall_sums(std::ostream& out) const {
    const WallSums sums = observers.need_wall_sums() ? loop->wall_sums() : WallSums();
    write_vector(out, sums.faces);
    write_vector(out, sums.slices);
    write_value(out, sums.scale.force);
    write_value(out, sums.scale.length);
}

std::string SimulatedBed::Impl::gathered() const {
    std::ostringstream out;
    save_wall_sums(out);
    observers.save(out);
    return out.str();
}

std::uint64_t SimulatedBed::state_hash() const {
    std::ostringstream out;
    write_state(out, impl_->step, impl_->grains, *impl_->loop, impl_->feeder.given());
    const std::string bytes = out.str();
    return XXH64(bytes.data(), bytes.size(), 0);
}

CheckpointHeader SimulatedBed::Impl::header() const {
    CheckpointHeader header;
    header.step = step;
    header.start_energy = start_energy;
    if (scene.drive.moves == Drive::Moves::container) {
        header.wall_offset = around.motion.at(step).offset;
        header.wall_velocity = around.motion.at(step).velocity;
    }
    return header;
}

void SimulatedBed::save_checkpoint(const std::filesystem::path& path) const {
    const Impl& m = *impl_;
    grainreel::save_checkpoint(path, m.scene, m.plan, m.header(), m.grains, *m.loop, m.gathered(),
                               m.feeder.given());
}

}  // namespace grainreel
