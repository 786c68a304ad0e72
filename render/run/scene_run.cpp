#include "render/run/scene_run.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text_file.hpp"
#include "engine/scene/text/writer.hpp"
#include "engine/start/grain_table.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

SceneRun::SceneRun(const Scene& scene, const Plan& plan, int threads)
    : scene_(scene), plan_(plan), simulation_(scene, plan, threads) {}

void SceneRun::use_folder(const FolderLock& folder) {
    folder_ = &folder;
    replace_file(path_of("scene.toml"), resolved_scene(scene_, plan_));
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
    return fmt::format("packed {} grains: {:.3g} s of settling, solid fraction {:.3f}", simulation_.grains(),
                       packing_.settle_time, packing_.solid_fraction);
}

std::optional<std::string> SceneRun::packing_warning() const {
    if (packing_.settled) return std::nullopt;
    return fmt::format(
        "{}: the bed still moves after {:.3g} s of settling ({:.2g} J a grain); raise start.settle_limit",
        scene_.where("start.settle_limit"), packing_.settle_time, packing_.kinetic_per_grain);
}

void SceneRun::start(std::vector<Shot> shots, const std::vector<FilmSegment>& segments, bool may_leave_out) {
    bed_periods_.emplace(scene_, plan_.clock, shots, may_leave_out);
    segments_ = segments;
    const std::vector<int> multiples = bed_periods_->possible();
    files_.emplace(folder_->folder(), scene_, plan_, simulation_.grains());
    const double depth = scene_.container.periodic_depth ? scene_.container.depth : 0;
    if (needs_displacement(scene_.film.shows))
        earlier_ = EarlierPositions(shots, plan_.clock.steps_per_period, multiples, first_step_, depth);
    exposed_ = ExposedMoments(shots, segments, plan_.clock, multiples, first_step_);
    means_ = PeriodMeans(shots, segments, plan_.clock, multiples, first_step_, depth);
    std::set<std::int64_t> moments;
    for (const auto* steps : {&earlier_.steps(), &exposed_.steps(), &means_.steps()})
        moments.insert(steps->begin(), steps->end());
    agenda_.emplace(std::move(shots), plan_.trajectory_every, plan_.measures_every, first_step_, plan_.steps,
                    std::move(moments), bed_periods_->every());
    shots_ = agenda_->shots();
    save_checkpoint();  // of a packing that may have taken hours
}

std::optional<SceneRun::Taken> SceneRun::next(const GoOn& go_on) {
    while (std::optional<Stop> stop = agenda_->next()) {
        if (!advance_to(stop->step, go_on)) return std::nullopt;
        if (stop->strobe) bed_periods_->note(stop->step, simulation_.centre_height());
        leave_out_pictures(*stop);
        FramePtr frame = serve(*stop);
        if (!stop->segments.empty()) return Taken{std::move(frame), stop->segments, bed_periods_->shown()};
    }
    return std::nullopt;
}

std::vector<std::string> SceneRun::news() const {
    return bed_periods_ ? bed_periods_->news() : std::vector<std::string>{};
}

void SceneRun::leave_out_pictures(Stop& stop) {
    if (stop.segments.empty()) return;
    std::erase_if(stop.segments, [&](int segment) {
        return !bed_periods_->shows(segments_.at(static_cast<std::size_t>(segment)), {stop.step, segment});
    });
    if (!stop.segments.empty()) return;
    earlier_.leave_out(stop.step);
    exposed_.leave_out(stop.step);
    means_.leave_out(stop.step);
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
        const double seconds = stretch.seconds();
        pace_.took(to - from, seconds);
        const double work = static_cast<double>(to - from) * static_cast<double>(simulation_.grains());
        particle_steps_ += work;
        rate_.add(work, seconds);
        if (checkpoints_.due()) save_checkpoint();
    }
    return go_on();
}

FramePtr SceneRun::serve(const Stop& stop) {
    if (stop.measures) {
        const auto timer = times_.during("measuring");
        add_measures();
    }
    if (!stop.trajectory && !stop.moment && stop.segments.empty()) return nullptr;
    const auto frame = std::make_shared<Frame>(simulation_.frame());
    if (stop.trajectory) {
        const auto timer = times_.during("writing");
        files_->add_frame(*frame, simulation_);
    }
    if (stop.moment) {
        earlier_.keep(*frame);
        exposed_.keep(*frame);
        means_.keep(*frame);
    }
    if (!stop.segments.empty()) add_what_the_film_needs(*frame);
    return frame;
}

void SceneRun::add_measures() {
    Measures measures = simulation_.measures();
    measures.bed_periods = bed_periods_->found();
    files_->add_measures(measures);
}

void SceneRun::add_what_the_film_needs(Frame& frame) {
    const FilmShows& look = scene_.film.shows;
    const int periods = bed_periods_->shown();
    earlier_.fill(frame, periods);
    exposed_.fill(frame, periods);
    means_.fill(frame, periods);
    if (needs_touches(look))
        for (const Simulation::ContactRecord& contact : simulation_.contacts())
            frame.touches.push_back({contact.first, contact.second, contact.normal});
    if (!needs_measures(look)) return;
    frame.measures = files_->measures();
    frame.measure_rows = frame.measures->rows();
}

void SceneRun::save_checkpoint() {
    folder_->check_there();
    const auto timer = times_.during("writing");
    const Stopwatch writing;
    simulation_.save_checkpoint(path_of("checkpoint.grs"));
    checkpoints_.saved(writing.seconds());
}

void SceneRun::close(FirstFailure& failure) {
    if (!packed_ || !folder_->is_there()) return;
    failure.attempt([&] {
        if (files_ && files_->last_measures() && files_->last_measures()->step != simulation_.step())
            add_measures();
    });
    failure.attempt([&] { write_grain_table(path_of("final.csv"), simulation_.frame()); });
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
    if (files_->has_contacts()) text += "contacts.nc, ";
    return text + fmt::format("measures.csv ({} rows), final.csv, checkpoint.grs, scene.toml, run.json",
                              files_->measures_rows());
}

void SceneRun::describe(RunRecord& record) const {
    record.scene_file = scene_.file;
    record.vector = vector_instructions();
    record.seed = scene_.run.seed;
    record.engine_threads = simulation_.threads();
    record.grains = scene_.grains();
    record.steps_planned = plan_.steps;
    record.step = plan_.clock.step;
}

void SceneRun::conclude(RunRecord& record) const {
    record.particle_steps_per_second = speed();
    record.trajectory_frames = files_ ? files_->trajectory_frames() : 0;
    record.measures_rows = files_ ? files_->measures_rows() : 0;
    record.state_hash = state_hash_;
    if (!packed_) return;
    record.steps = simulation_.step();
    record.simulated = plan_.clock.time(record.steps);
}

}  // namespace grainreel
