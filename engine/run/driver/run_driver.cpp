#include "engine/run/driver/run_driver.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/former_files.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_names.hpp"
#include "engine/grain_table.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/run/driver/packing_cache.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

namespace {

// Makes a hard link that replaces the file `name`. Returns false if the file system has no hard links.
bool give_second_name(const std::filesystem::path& file, const std::filesystem::path& name) {
    const std::filesystem::path part = name.string() + ".part";
    std::error_code error;
    std::filesystem::remove(part, error);
    std::filesystem::create_hard_link(file, part, error);
    if (!error) std::filesystem::rename(part, name, error);
    return !error;
}

}  // namespace

RunDriver::RunDriver(const Scene& scene, const Plan& plan, int threads)
    : scene_(scene), plan_(plan), simulation_(scene, plan, threads) {}

RunDriver::RunDriver(const Scene& scene, const Plan& plan, ResumePoint point)
    : scene_(scene),
      plan_(plan),
      simulation_(std::move(point.simulation)),
      packed_(true),
      first_step_(point.first),
      goes_on_(true),
      frames_before_(point.frames),
      former_end_(point.reached),
      changed_(point.changed),
      accepted_(std::move(point.accepted)),
      settled_(point.settled) {
    if (point.deepest) simulation_.set_deepest_contact(std::move(*point.deepest));
}

void RunDriver::keep_former(const FolderLock& folder, bool hands_out, const std::string& program_version) {
    folder_ = &folder;
    FormerFiles former(folder.folder());
    const std::optional<std::size_t> frames = hands_out ? std::optional(frames_before_) : std::nullopt;
    ready_ = ready_files(folder.folder(), scene_, plan_, simulation_, frames, program_version, former);
    former.begin();
    former_kept_ = true;
}

// Removes the saved former state once the run has gone past its former end. A run may also end exactly there,
// to finish its film; its files are then whole again too.
void RunDriver::let_former_go(bool at_its_end) {
    if (!former_kept_ || !(at_its_end || simulation_.step() > former_end_)) return;
    FormerFiles::let_go(folder_->folder());
    former_kept_ = false;
}

void RunDriver::put_back() {
    files_.reset();
    FormerFiles::put_back(folder_->folder());
    former_kept_ = false;
}

void RunDriver::use_folder(const FolderLock& folder, const std::string& program_version,
                           const std::filesystem::path& previous) {
    folder_ = &folder;
    program_version_ = program_version;
    keep_mesh_files(scene_, folder.folder(), previous);
    std::string text = resolved_scene(scene_, plan_);
    if (goes_on_) text = with_comments_of(load_scene_file(path_of("scene.toml")), std::move(text));
    replace_file(path_of("scene.toml"), text);
}

bool RunDriver::pack(const PackingWatcher& watcher) {
    const auto timer = times_.during("packing");
    const std::string key = shortest_kept_ ? simulation_.packing_key() : "";
    if (!take_kept_packing(key)) {
        const Stopwatch packing;
        packing_ = simulation_.pack(
            [&](const PackingProgress& now) {
                folder_->check_there();
                return watcher(now);
            },
            [&](const PackingResult& result) { keep_packing_of(key, result, packing.seconds()); });
        if (!packing_.finished) return false;
    }
    if (packing_.settle_time > 0) settled_ = packing_.settle_time;
    first_step_ = simulation_.step();
    packed_ = true;
    return true;
}

bool RunDriver::take_kept_packing(const std::string& key) {
    const std::filesystem::path place = place_of_packing(key);
    if (place.empty() || !is_own_packing(place)) return false;
    auto found = SimulatedBed::with_packing(scene_, plan_, place, key, simulation_.threads(), packing_);
    if (!found) return false;
    simulation_ = std::move(*found);
    note_packing_used(place);
    found_packing_ = true;
    return true;
}

void RunDriver::keep_packing_of(const std::string& key, const PackingResult& result, double seconds) {
    const std::filesystem::path place = place_of_packing(key);
    if (place.empty() || seconds < *shortest_kept_) return;
    not_kept_ = keep_packing(
        place, [&](const std::filesystem::path& file) { simulation_.save_packing(file, key, result); });
}

void RunDriver::start(FilmWishes wishes) {
    wishes_ = std::move(wishes);
    kept_ = std::move(wishes_.kept);
    open_files();
    if (changed_) {
        std::error_code ignored;
        std::filesystem::create_directory(path_of(CheckpointRing::kFolder), ignored);
        simulation_.save_checkpoint(place_in_ring(folder_->folder(), simulation_.step()));
    }
    if (scene_.output.checkpoints)
        ring_.emplace(folder_->folder(), *scene_.output.checkpoints, simulation_.step(), plan_.steps);
    agenda_.emplace(wishes_.steps, Rhythm(plan_.trajectory_every, plan_.trajectory_periods),
                    Rhythm(plan_.measures_every, plan_.measures_periods), simulation_.step(), plan_.steps,
                    kept_.steps(), plan_.clock, files_->has_fields() ? &plan_.fields : nullptr);
    if (files_->keeps_key_moments())
        agenda_->want_keys(key_steps(scene_, plan_, first_step_, wishes_.key_times));
    if (simulation_.step() > first_step_) agenda_->goes_on();
    save_checkpoint();  // a packing may have taken hours
}

void RunDriver::open_files() {
    const std::filesystem::path& folder = folder_->folder();
    if (!goes_on_) {
        files_.emplace(folder, scene_, plan_, simulation_, program_version_, wishes_.keep_rows);
        if (wishes_.to_file) files_->keep_film_moments();
        if (wishes_.key_moments && plan_.trajectory_every > 0) files_->keep_key_moments();
        files_->add_departures(simulation_);  // those that left when the drive started
        return;
    }
    files_.emplace(RunFiles::GoesOn(), folder, scene_, plan_, simulation_, program_version_,
                   wishes_.keep_rows);
    if (ready_.key_moments) files_->keep_key_moments(simulation_.step());
    if (!ready_.key_moments_lost.empty())
        news_.push_back(fmt::format("{}; the run's page may lack forces of moments before {:.4g} s",
                                    ready_.key_moments_lost, plan_.clock.time(simulation_.step())));
    if (!wishes_.steps.empty() && is_there(folder / kFilmMoments)) files_->keep_film_moments(frames_before_);
}

std::shared_ptr<State> RunDriver::next(const GoOn& go_on) {
    if (handed_out_) kept_.done_with(*handed_out_);
    handed_out_.reset();
    while (std::optional<Stop> stop = agenda_->next()) {
        if (!advance_to(stop->step, go_on)) return nullptr;
        if (wishes_.look) wishes_.look(simulation_);
        if (stop->frame && wishes_.left_out && wishes_.left_out(stop->step)) {
            stop->frame = false;
            kept_.done_with(stop->step);
        }
        std::shared_ptr<State> frame = serve(*stop);
        if (!stop->frame) continue;
        handed_out_ = stop->step;
        return frame;
    }
    let_former_go(true);
    return nullptr;
}

bool RunDriver::advance_to(std::int64_t target, const GoOn& go_on) {
    while (simulation_.step() < target) {
        if (!go_on()) return false;
        folder_->check_there();
        const std::int64_t from = simulation_.step();
        const std::int64_t to = std::min(target, from + pace_.steps());
        Stopwatch stretch;
        {
            const auto timer = times_.during("engine");
            simulation_.advance(to);
        }
        files_->add_departures(simulation_);
        let_former_go(false);
        const double seconds = stretch.seconds();
        pace_.took(to - from, seconds);
        const double work = static_cast<double>(to - from) * static_cast<double>(simulation_.grains());
        particle_steps_ += work;
        rate_.add(work, seconds);
        if (checkpoints_.due() || ring_due()) save_checkpoint();
    }
    return go_on();
}

// Does the work of a stop. The frame is null if none is wanted.
std::shared_ptr<State> RunDriver::serve(const Stop& stop) {
    if (stop.measures) {
        const auto timer = times_.during("measuring");
        add_measures();
    }
    if (stop.fields) {
        const auto timer = times_.during("writing");
        files_->add_fields(simulation_);
    }
    if (!stop.trajectory && !stop.key && !stop.moment && !stop.frame) return nullptr;
    auto frame = std::make_shared<State>(simulation_.frame());
    const bool filed = files_->keeps_film_moments() && stop.frame;
    if (stop.trajectory || stop.key || filed) {
        const auto timer = times_.during("writing");
        const RunFiles::Contacts contacts = simulation_.contacts();
        count_contacts(*frame, contacts);
        if (stop.trajectory) files_->add_frame(*frame, contacts);
        if (stop.key) files_->add_key_moment(*frame, contacts);
    }
    if (stop.moment) kept_.keep(*frame);
    if (filed) {
        const auto timer = times_.during("writing");
        files_->add_film_moment(*frame);
    }
    return frame;
}

void RunDriver::add_measures() {
    const Measures now = simulation_.measures();
    if (now.at("largest_overlap") > simulation_.told_overlap()) simulation_.note_overlap();
    files_->add_measures(now);
}

bool RunDriver::ring_due() const {
    return ring_ && ring_->due(simulation_.step()) && checkpoints_.affordable();
}

// A checkpoint of the ring is also the run's last one, under a second name.
void RunDriver::save_checkpoint() {
    folder_->check_there();
    const auto timer = times_.during("writing");
    const Stopwatch writing;
    const std::filesystem::path last = path_of("checkpoint.grs");
    const auto save = [&](const std::filesystem::path& file) { simulation_.save_checkpoint(file); };
    if (!ring_ || !ring_->due(simulation_.step())) {
        save(last);
    } else {
        ring_->add(simulation_.step(), [&](const std::filesystem::path& file) {
            save(file);
            if (!give_second_name(file, last)) save(last);
        });
    }
    checkpoints_.saved(writing.seconds());
}

void RunDriver::close(FirstFailure& failure) {
    if (!packed_ || folder_ == nullptr || !folder_->is_there()) return;
    // A run that ends between pack() and start() has its files too, so that its checkpoint can go on.
    if (!files_ && !goes_on_) failure.attempt([&] { open_files(); });
    failure.attempt([&] {
        if (files_ && files_->last_measures() &&
            files_->last_measures()->at("step") != static_cast<double>(simulation_.step()))
            add_measures();
    });
    failure.attempt([&] { final_table_ = write_grain_table(path_of(kFinalTable), simulation_.frame()); });
    failure.attempt([&] { save_checkpoint(); });
    failure.attempt([&] { state_hash_ = simulation_.state_hash(); });
}

// Texts about the run for its user, and for run.json.
std::string RunDriver::found_packing_text() const {
    if (!found_packing_) return "";
    return fmt::format(
        "took the packing of an earlier run of this start from the cache: {}, solid fraction {:.3f}; "
        "--no-cache packs anew",
        counted(simulation_.grains(), "grain"), packing_.solid_fraction);
}

std::string RunDriver::packing_text() const {
    const std::string not_kept =
        not_kept_.empty() ? "" : fmt::format("; for later runs it is not kept: {}", not_kept_);
    if (scene_.start.method == Start::Method::file)
        return fmt::format("took {} from {}; {}", counted(simulation_.grains(), "grain"), scene_.start.file,
                           plan_.start.relaxes && packing_.settled
                               ? fmt::format("relaxed for {:.3g} s", packing_.settle_time)
                               : plan_.start.text);
    return fmt::format("packed {}: {:.3g} s of settling, solid fraction {:.3f}{}",
                       counted(simulation_.grains(), "grain"), packing_.settle_time, packing_.solid_fraction,
                       not_kept);
}

std::vector<std::string> RunDriver::packing_warnings() const {
    std::vector<std::string> warnings;
    if (const auto one = settling_warning()) warnings.push_back(*one);
    if (packing_.left > 0)
        warnings.push_back(
            fmt::format("{}: {} of {} ({:.3g} % of their volume) lay in an exit when the bed was packed, and "
                        "left at 0 s; "
                        "unless you mean that, move the exit away from the bed",
                        scene_.where(scene_.exits.empty() ? "container.outlet" : "exit[0]"), packing_.left,
                        counted(packing_.left + simulation_.grains(), "grain"), 100 * packing_.left_share));
    return warnings;
}

std::optional<std::string> RunDriver::overlap_warning() const {
    const std::string text = simulation_.overlap_text();
    if (text.empty()) return std::nullopt;
    return fmt::format("{}: {}", scene_.where("run.overlap"), text);
}

std::optional<std::string> RunDriver::settling_warning() const {
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
        text += fmt::format("trajectory.nc ({}), ", counted(files_->trajectory_frames(), "frame"));
    if (files_->keeps_film_moments()) text += "film_moments.nc, ";
    if (files_->keeps_key_moments()) text += "key_moments.nc, key_contacts.nc, ";
    if (files_->has_contacts()) text += "contacts.nc, ";
    if (files_->has_fields())
        text += fmt::format("fields.nc ({}), ", counted(files_->field_records(), "record"));
    if (const auto rows = files_->outflow_rows())
        text += fmt::format("outflow.csv ({}), ", counted(*rows, "grain"));
    text += fmt::format("measures.csv ({}), final.csv, checkpoint.grs, ",
                        counted(files_->measures_rows(), "row"));
    if (ring_) text += fmt::format("checkpoints/ ({}), ", ring_->kept().size());
    return text + "scene.toml, run.json";
}

void RunDriver::describe(RunJson& record) const {
    record.scene_file = scene_.file;
    record.vector = vector_instructions();
    record.seed = scene_.run.seed;
    record.engine_threads = simulation_.threads();
    record.grains = scene_.grains();
    record.steps_planned = plan_.steps;
    record.step = plan_.clock.step;
    record.accepted = accepted_;
}

void RunDriver::conclude(RunJson& record) const {
    record.particle_steps_per_second = speed();
    record.trajectory_frames = files_ ? files_->trajectory_frames() : 0;
    record.measures_rows = files_ ? files_->measures_rows() : 0;
    record.state_hash = state_hash_;
    record.final_table = final_table_;
    if (!packed_) return;
    record.settled = settled_;
    if (simulation_.deepest_contact().share > 0) record.deepest = simulation_.deepest_contact();
    record.steps = simulation_.step();
    record.simulated = plan_.clock.time(record.steps);
}

}  // namespace grainreel
