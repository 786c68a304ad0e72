#include "render/run/scene_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text_file.hpp"
#include "engine/files/former_run.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/file/scene_file.hpp"
#include "engine/scene/text/comments.hpp"
#include "engine/state/grain_table.hpp"
#include "engine/vector/instructions.hpp"
#include "render/run/moments/key_moments.hpp"

namespace grainreel {

namespace {

// A hard link that takes the place of what `name` was. False where the file system knows none.
bool give_second_name(const std::filesystem::path& file, const std::filesystem::path& name) {
    const std::filesystem::path part = name.string() + ".part";
    std::error_code error;
    std::filesystem::remove(part, error);
    std::filesystem::create_hard_link(file, part, error);
    if (!error) std::filesystem::rename(part, name, error);
    return !error;
}

}  // namespace

SceneRun::SceneRun(const Scene& scene, const Plan& plan, int threads)
    : scene_(scene), plan_(plan), simulation_(scene, plan, threads) {}

SceneRun::SceneRun(const Scene& scene, const Plan& plan, ResumePoint point)
    : scene_(scene),
      plan_(plan),
      simulation_(std::move(point.simulation)),
      packed_(true),
      first_step_(point.first),
      goes_on_(true),
      pictures_kept_(point.pictures),
      former_end_(point.reached),
      changed_(point.changed),
      accepted_(std::move(point.accepted)) {}

void SceneRun::keep_former(const FolderLock& folder, const Pictures& pictures,
                           const std::string& program_version) {
    folder_ = &folder;
    FormerRun former(folder.folder());
    const std::optional<std::size_t> kept =
        shots_of(pictures).empty() ? std::nullopt : std::optional(pictures_kept_);
    ready_ = ready_files(folder.folder(), scene_, plan_, simulation_, kept, program_version, former);
    former.begin();
    former_kept_ = true;
}

// Of a run that ends where it was, its film being unfinished, all files are whole again by then.
void SceneRun::let_former_go(bool at_its_end) {
    if (!former_kept_ || !(at_its_end || simulation_.step() > former_end_)) return;
    FormerRun::let_go(folder_->folder());
    former_kept_ = false;
}

void SceneRun::put_back() {
    earlier_.reset();
    files_.reset();
    FormerRun::put_back(folder_->folder());
    former_kept_ = false;
}

void SceneRun::use_folder(const FolderLock& folder, const std::string& program_version) {
    folder_ = &folder;
    program_version_ = program_version;
    std::string text = resolved_scene(scene_, plan_);
    if (goes_on_) text = with_comments_of(load_scene_file(path_of("scene.toml")), std::move(text));
    replace_file(path_of("scene.toml"), text);
}

bool SceneRun::pack(const PackingWatcher& watcher) {
    const auto timer = times_.during("packing");
    packing_ = simulation_.pack([&](const PackingProgress& now) {
        folder_->check_there();
        return watcher(now);
    });
    if (!packing_.finished) return false;
    first_step_ = simulation_.step();
    packed_ = true;
    return true;
}

std::string SceneRun::packing_text() const {
    if (scene_.start.method == Start::Method::file)
        return fmt::format("took {} grains from {}; {}", simulation_.grains(), scene_.start.file,
                           plan_.start.relaxes && packing_.settled
                               ? fmt::format("relaxed for {:.3g} s", packing_.settle_time)
                               : plan_.start.text);
    return fmt::format("packed {} grains: {:.3g} s of settling, solid fraction {:.3f}", simulation_.grains(),
                       packing_.settle_time, packing_.solid_fraction);
}

std::optional<std::string> SceneRun::packing_warning() const {
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

// What pictures may take from it. Its moments are those that were kept for them.
class SceneRun::Parts final : public PartSupply {
  public:
    explicit Parts(const SceneRun& run) : run_(run) {}
    FramePtr at(std::int64_t step) const override { return run_.kept_.at(step); }
    std::vector<Touch> touches(const Frame&) const override {
        std::vector<Touch> touches;
        for (const Simulation::ContactRecord& contact : run_.simulation_.contacts())
            touches.push_back({contact.first, contact.second, contact.normal});
        return touches;
    }
    Measured measured(const Frame&) const override {
        const std::shared_ptr<const MeasureTable> table = run_.files_->measures();
        return {table, table->rows()};
    }
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override {
        return run_.files_->flowed_out(frame.time);
    }

  private:
    const SceneRun& run_;
};

Span SceneRun::span() const {
    return {plan_.clock.time(first_step_), scene_.run.duration};
}

std::vector<Shot> SceneRun::shots_of(const Pictures& pictures) const {
    return shots_at(pictures.instants, pictures.segments, plan_.clock, plan_.steps);
}

std::vector<Frame> SceneRun::moments(const Pictures& pictures) const {
    std::vector<Frame> moments;
    for (const Shot& shot : shots_of(pictures)) {
        Frame& moment = moments.emplace_back();
        moment.step = shot.step;
        moment.time = plan_.clock.time(shot.step);
        moment.cycles = plan_.clock.cycles(shot.step);
        moment.phase = plan_.clock.phase(shot.step);
    }
    return moments;
}

void SceneRun::start(const Pictures& pictures) {
    const std::vector<Shot> shots = shots_of(pictures);
    segments_ = pictures.segments;
    bed_periods_.emplace(scene_, plan_.clock, shots, segments_, pictures.may_leave_out);
    open_files(shots);
    if (changed_) {
        std::error_code ignored;
        std::filesystem::create_directory(path_of(CheckpointRing::kFolder), ignored);
        simulation_.save_checkpoint(place_in_ring(folder_->folder(), simulation_.step()));
    }
    if (scene_.output.checkpoints)
        ring_.emplace(folder_->folder(), *scene_.output.checkpoints, simulation_.step(), plan_.steps);
    want_moments(shots);
    agenda_.emplace(shots, Rhythm(plan_.trajectory_every, plan_.trajectory_periods),
                    Rhythm(plan_.measures_every, plan_.measures_periods), simulation_.step(), plan_.steps,
                    kept_.steps(), plan_.clock, files_->has_fields() ? &plan_.fields : nullptr);
    if (files_->keeps_key_moments()) agenda_->want_keys(key_steps(scene_, plan_, first_step_));
    if (simulation_.step() > first_step_) agenda_->goes_on();
    // As far as one knows: what a bed of several periods leaves out is found later.
    shots_ = std::count_if(shots.begin(), shots.end(), [&](const Shot& shot) {
        const FilmSegment& rule = segments_.at(static_cast<std::size_t>(shot.segment));
        return shot.step >= first_step_ && bed_periods_->shows(rule, shot);
    });
    save_checkpoint();  // of a packing that may have taken hours
}

void SceneRun::open_files(const std::vector<Shot>& shots) {
    const std::filesystem::path& folder = folder_->folder();
    if (!goes_on_) {
        files_.emplace(folder, scene_, plan_, simulation_, program_version_);
        if (film_moments_bytes(scene_, plan_, std::ssize(shots)) > 0) files_->keep_film_moments();
        if (keys_wanted_ && plan_.trajectory_every > 0) files_->keep_key_moments();
        return;
    }
    files_.emplace(RunFiles::GoesOn(), folder, scene_, plan_, simulation_, program_version_);
    if (ready_.key_moments) files_->keep_key_moments(simulation_.step());
    if (!ready_.key_moments_lost.empty())
        news_.push_back(fmt::format("{}; the run's page may lack forces of moments before {:.4g} s",
                                    ready_.key_moments_lost, plan_.clock.time(simulation_.step())));
    std::error_code ignored;
    if (shots.empty() || !std::filesystem::exists(folder / kFilmMoments, ignored)) return;
    files_->keep_film_moments(pictures_kept_);
    earlier_.emplace(scene_, plan_.clock, folder, shots, pictures_kept_, files_->measures(), *files_);
}

// Whatever number of periods the bed will turn out to repeat itself after.
void SceneRun::want_moments(const std::vector<Shot>& shots) {
    parts_.emplace(scene_, plan_.clock, first_step_);
    const std::vector<int> multiples = bed_periods_->possible();
    for (const Shot& shot : shots)
        for (const int periods : multiples)
            kept_.want(shot.step, parts_->moments(shot.step, rule(shot.segment), periods));
}

std::optional<Taken> SceneRun::next(const GoOn& go_on) {
    if (std::optional<Taken> picture = waiting()) return picture;
    if (earlier_ && !go_on()) return std::nullopt;
    if (earlier_)
        if (std::optional<Taken> picture = earlier_->next()) return picture;
    earlier_.reset();
    while (std::optional<Stop> stop = agenda_->next()) {
        if (!advance_to(stop->step, go_on)) return std::nullopt;
        look_at_bed_periods();
        leave_out_pictures(*stop);
        frame_ = serve(*stop);
        segments_waiting_ = stop->segments;
        if (std::optional<Taken> picture = waiting()) return picture;
    }
    let_former_go(true);
    return std::nullopt;
}

std::optional<Taken> SceneRun::waiting() {
    if (segments_waiting_.empty()) return std::nullopt;
    const int segment = segments_waiting_.front();
    segments_waiting_.erase(segments_waiting_.begin());
    FramePtr frame = segments_waiting_.empty() ? std::move(frame_) : frame_;
    return Taken{std::move(frame), segment, bed_periods_->shown()};
}

std::vector<std::string> SceneRun::news() const {
    std::vector<std::string> news = news_;
    if (bed_periods_) {
        const std::vector<std::string> of_bed = bed_periods_->news();
        news.insert(news.end(), of_bed.begin(), of_bed.end());
    }
    return news;
}

void SceneRun::leave_out_pictures(Stop& stop) {
    if (stop.segments.empty()) return;
    std::erase_if(stop.segments, [&](int segment) {
        return !bed_periods_->shows(rule(segment), {stop.step, segment});
    });
    if (stop.segments.empty()) kept_.done_with(stop.step);
}

bool SceneRun::advance_to(std::int64_t target, const GoOn& go_on) {
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

FramePtr SceneRun::serve(const Stop& stop) {
    if (stop.measures) {
        const auto timer = times_.during("measuring");
        add_measures();
    }
    if (stop.fields) {
        const auto timer = times_.during("writing");
        files_->add_fields(simulation_);
    }
    if (!stop.trajectory && !stop.key && !stop.moment && stop.segments.empty()) return nullptr;
    const auto frame = std::make_shared<Frame>(simulation_.frame());
    const bool pictured = files_->keeps_film_moments() && !stop.segments.empty();
    if (stop.trajectory || stop.key || pictured) {
        const auto timer = times_.during("writing");
        const RunFiles::Contacts contacts = simulation_.contacts();
        count_contacts(*frame, contacts);
        if (stop.trajectory) files_->add_frame(*frame, contacts);
        if (stop.key) files_->add_key_moment(*frame, contacts);
    }
    if (stop.moment) kept_.keep(*frame);
    if (stop.segments.empty()) return frame;
    if (pictured) {
        const auto timer = times_.during("writing");
        files_->add_film_moment(*frame);
    }
    parts_->add(*frame, rule(stop.segments.back()), bed_periods_->shown(), Parts(*this));
    kept_.done_with(stop.step);
    return frame;
}

void SceneRun::look_at_bed_periods() {
    bed_periods_->note(simulation_.step(), static_cast<int>(simulation_.measure("bed_periods")),
                       simulation_.measure("period_difference_m"));
}

void SceneRun::add_measures() {
    files_->add_measures(simulation_.measures());
}

bool SceneRun::ring_due() const {
    return ring_ && ring_->due(simulation_.step()) && checkpoints_.affordable();
}

// One of the ring is the run's last one too, under a second name.
void SceneRun::save_checkpoint() {
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

void SceneRun::close(FirstFailure& failure) {
    if (!packed_ || folder_ == nullptr || !folder_->is_there()) return;
    failure.attempt([&] {
        if (files_ && files_->last_measures() &&
            files_->last_measures()->at("step") != static_cast<double>(simulation_.step()))
            add_measures();
    });
    failure.attempt([&] { final_table_ = write_grain_table(path_of(kFinalTable), simulation_.frame()); });
    failure.attempt([&] { save_checkpoint(); });
    failure.attempt([&] { state_hash_ = simulation_.state_hash(); });
}

double SceneRun::done() const {
    return static_cast<double>(simulation_.step() - first_step_) /
           static_cast<double>(plan_.steps - first_step_);
}

double SceneRun::speed() const {
    const double engine = times_.of("engine");
    return engine > 0 ? particle_steps_ / engine : 0;
}

std::string SceneRun::files_text() const {
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

void SceneRun::describe(RunRecord& record) const {
    record.scene_file = scene_.file;
    record.vector = vector_instructions();
    record.seed = scene_.run.seed;
    record.engine_threads = simulation_.threads();
    record.grains = scene_.grains();
    record.steps_planned = plan_.steps;
    record.step = plan_.clock.step;
    record.accepted = accepted_;
}

void SceneRun::conclude(RunRecord& record) const {
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
