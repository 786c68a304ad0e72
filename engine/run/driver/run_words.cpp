// What a run says of itself: to its user, and in run.json.
#include <fmt/format.h>

#include "engine/run/driver/run_driver.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

std::string RunDriver::found_packing_text() const {
    if (!found_packing_) return "";
    return fmt::format(
        "took the packing of an earlier run of this start from the cache: {} grains, solid fraction {:.3f}; "
        "--no-cache packs anew",
        simulation_.grains(), packing_.solid_fraction);
}

std::string RunDriver::packing_text() const {
    const std::string not_kept =
        not_kept_.empty() ? "" : fmt::format("; for later runs it is not kept: {}", not_kept_);
    if (scene_.start.method == Start::Method::file)
        return fmt::format("took {} grains from {}; {}", simulation_.grains(), scene_.start.file,
                           plan_.start.relaxes && packing_.settled
                               ? fmt::format("relaxed for {:.3g} s", packing_.settle_time)
                               : plan_.start.text);
    return fmt::format("packed {} grains: {:.3g} s of settling, solid fraction {:.3f}{}",
                       simulation_.grains(), packing_.settle_time, packing_.solid_fraction, not_kept);
}

std::optional<std::string> RunDriver::packing_warning() const {
    if (packing_.settled) return std::nullopt;
    if (plan_.start.relaxes)
        return fmt::format(
            "{}: the bed of '{}' does not rest in this scene: after {:.3g} s it still moved, or grains had "
            "moved "
            "away. It starts as it is in the file, and nothing is damped",
            scene_.where("start.file"), scene_.start.file, packing_.settle_time);
    return fmt::format(
        "{}: the bed still moves after {:.3g} s of settling ({:.2g} J a grain); raise start.settle_limit",
        scene_.where("start.settle_limit"), packing_.settle_time, packing_.kinetic_per_grain);
}

double RunDriver::done() const {
    return static_cast<double>(simulation_.step() - first_step_) /
           static_cast<double>(plan_.steps - first_step_);
}

double RunDriver::speed() const {
    const double engine = times_.of("engine");
    return engine > 0 ? particle_steps_ / engine : 0;
}

std::string RunDriver::files_text() const {
    std::string text;
    if (plan_.trajectory_every > 0)
        text += fmt::format("trajectory.nc ({} frames), ", files_->trajectory_frames());
    if (files_->keeps_film_moments()) text += "film_moments.nc, ";
    if (files_->keeps_key_moments()) text += "key_moments.nc, key_contacts.nc, ";
    if (files_->has_contacts()) text += "contacts.nc, ";
    if (files_->has_fields()) text += fmt::format("fields.nc ({} records), ", files_->field_records());
    if (const auto rows = files_->outflow_rows()) text += fmt::format("outflow.csv ({} grains), ", *rows);
    text += fmt::format("measures.csv ({} rows), final.csv, checkpoint.grs, ", files_->measures_rows());
    if (ring_) text += fmt::format("checkpoints/ ({}), ", ring_->kept().size());
    return text + "scene.toml, run.json";
}

void RunDriver::describe(RunRecord& record) const {
    record.scene_file = scene_.file;
    record.vector = vector_instructions();
    record.seed = scene_.run.seed;
    record.engine_threads = simulation_.threads();
    record.grains = scene_.grains();
    record.steps_planned = plan_.steps;
    record.step = plan_.clock.step;
    record.accepted = accepted_;
}

void RunDriver::conclude(RunRecord& record) const {
    record.particle_steps_per_second = speed();
    record.trajectory_frames = files_ ? files_->trajectory_frames() : 0;
    record.measures_rows = files_ ? files_->measures_rows() : 0;
    record.state_hash = state_hash_;
    record.final_table = final_table_;
    if (!packed_) return;
    record.steps = simulation_.step();
    record.simulated = plan_.clock.time(record.steps);
}

}  // namespace grainreel
