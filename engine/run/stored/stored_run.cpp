#include "engine/run/stored/stored_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_names.hpp"
#include "engine/state/checkpoint_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// The clock of the frames. Moments at step 0 alone do not tell it; then the scene's own step is taken.
Clock clock_of_frames(const Scene& scene, const StateArchive& frames) {
    const Clock clock = clock_of(scene, frames.moments());
    return clock.step == 0 && scene.run.step ? clock_of_steps(scene, *scene.run.step) : clock;
}

// Whether the folder of a run is there, and no reader of the calling program takes it.
bool is_run_folder(const fs::path& path) {
    if (!is_folder(path)) return false;
    FileStart head;
    head.path = path;
    head.folder = true;
    for (const std::shared_ptr<const OwnReader>& own : own_readers())
        if (own->takes(head)) return false;
    const ReadFormat* const reader = reader_of(path);
    return reader != nullptr && reader->name == std::string("run");
}

// Numbers of the frames that were left out, `count` of them.
std::vector<std::size_t> damaged_places(const StateArchive& frames, std::size_t count) {
    std::vector<std::size_t> places;
    std::size_t index = 0;
    for (std::size_t place = 0; places.size() < count; ++place) {
        if (index < frames.moments().size() && frames.place(index) == place)
            ++index;
        else
            places.push_back(place);
    }
    return places;
}

}  // namespace

StoredRun::StoredRun(const fs::path& path, const StoredRunRequest& request) : threads_(request.threads) {
    if (is_run_folder(path)) {
        read_folder(folder_of_run(path), request);
        return;
    }
    OpenRequest frames;
    frames.reading = request.reading;
    frames.scene_of_run = request.scene_of_run;
    take(open_frames(path, frames));
    if (threads_ && is_checkpoint(path)) restore(path);
}

StoredRun::StoredRun(std::shared_ptr<const StateArchive> frames) {
    take(std::move(frames));
}

StoredRun::~StoredRun() = default;

void StoredRun::take(std::shared_ptr<const StateArchive> frames) {
    frames_ = std::move(frames);
    kind_ = dynamic_cast<const ForeignArchive*>(frames_.get()) ? Kind::foreign : Kind::state;
    scene_ = frames_->scene() ? *frames_->scene() : scene_of(frames_->world());
    clock_ = clock_of_frames(scene_, *frames_);
}

void StoredRun::read_folder(const fs::path& folder, const StoredRunRequest& request) {
    OpenRequest frames{.format = "run", .scene_of_run = request.scene_of_run};
    frames_ = open_frames(folder, frames);
    is_folder_ = true;
    scene_ = *frames_->scene();
    const std::vector<std::string> damage = frames_->damage();
    if (moments().empty() && !damage.empty())
        throw UserError("{} (and no other frame is whole)", damage.front());
    kind_ = is_there(folder / kImportNews) ? Kind::imported
            : is_of_another_engine(folder) ? Kind::elsewhere
                                           : Kind::ours;
    clock_ = clock_of_frames(scene_, *frames_);
    faults_ = frames_->news();
    if (!damage.empty()) {
        faults_.resize(faults_.size() - damage.size());
        faults_.push_back(damage_line(damage.front(), damaged_places(*frames_, damage.size())));
    }
    const std::string trajectory = name_of("trajectory.nc");
    check_grains(scene_, world(), first_whole(), trajectory);
    for (std::size_t k = 0; k < moments().size(); ++k)
        check_drive(scene_, clock_, moments()[k], fmt::format("{}: frame {}", trajectory, place(k)));
    read_measures();
    if (request.contacts) use_contacts();
}

// The engine knows of a checkpoint's moment all that the run measured.
void StoredRun::restore(const fs::path& checkpoint) {
    const SimulatedBed run = run_of_checkpoint(checkpoint, 1);
    restored_ = run.frame();
    restored_measures_ = MeasuredRow{restored_->time, run.measured(), run.measures().values()};
}

StateSupply StoredRun::supply() const {
    StateSupply supply = frames_->supply();
    supply.contacts = supply.contacts || contacts_;
    supply.measures = supply.measures || measures_;
    return supply;
}

State StoredRun::grains(std::size_t index) const {
    return restored_ ? *restored_ : frames_->grains(number(index));
}

std::vector<std::string> StoredRun::news() const {
    std::vector<std::string> all = is_folder_ ? faults_ : frames_->news();
    all.insert(all.end(), news_.begin(), news_.end());
    return all;
}

std::int64_t StoredRun::last_step() const {
    const std::int64_t last = moments().back().step;
    return checkpoints().empty() ? last : std::max(last, checkpoints().back().step);
}

const KeptList& StoredRun::kept() const {
    const bool with_keys = false;
    if (!kept_) kept_ = std::make_unique<KeptList>(*this, scene_, clock_, with_keys);
    return *kept_;
}

std::optional<std::size_t> StoredRun::index_near(double time) const {
    constexpr double periods = 1e-3, steps = 1.01;
    const double period = scene_.drive.present ? 1 / scene_.drive.highest_frequency() : 0;
    const std::size_t index = nearest(time);
    if (std::abs(moments()[index].time - time) > std::max(periods * period, steps * clock_.step))
        return std::nullopt;
    return index;
}

Origin StoredRun::origin_of(std::int64_t step, bool with_contacts) const {
    const std::optional<std::size_t> index = kept().find(step);
    const bool in_trajectory = index && kept().place_of(*index).trajectory;
    if (index && (!with_contacts || kept().has_contacts_of(*index)))
        return in_trajectory ? Origin::trajectory : Origin::film_moments;
    if (brings_back(step)) return Origin::checkpoint;
    return in_trajectory ? Origin::trajectory : Origin::nowhere;
}

std::optional<StoredMoment> StoredRun::at(std::int64_t step, bool with_contacts,
                                          const ReplayWatcher& watcher) {
    const Origin origin = origin_of(step, with_contacts);
    std::optional<DamagedFrame> damage;
    if (origin == Origin::trajectory || origin == Origin::film_moments) {
        const std::size_t index = *kept().find(step);
        try {
            StoredMoment moment{kept().grains(index), origin};
            if (with_contacts) moment.touches = kept().touches(index);
            return moment;
        } catch (const DamagedFrame& problem) {
            damage = problem;
        }
    }
    if (!brings_back(step) && damage) throw *damage;
    if (!brings_back(step))
        throw UserError("{}: {:.6g} s was not kept, and cannot be brought back", path().string(),
                        clock_.time(step));
    bool stopped = false;
    try {
        const SimulatedBed& run =
            brought_back(step, [&](double done) { return !(stopped = !watcher(done)); });
        StoredMoment moment{run.frame(), Origin::checkpoint};
        if (with_contacts) moment.touches = touches_of(run);
        return moment;
    } catch (const RunError&) {
        if (stopped) return std::nullopt;
        throw;
    }
}

Replayer& StoredRun::replayer() {
    const int threads = threads_.value_or(0) > 0 ? *threads_ : scene_.run.threads;
    if (!replayer_) replayer_.emplace(path(), checkpoints(), threads);
    return *replayer_;
}

SimulatedBed& StoredRun::brought_back(std::int64_t step, const ReplayWatcher& watcher) {
    prove(step, watcher);
    return replayer().at(step, watcher);
}

void StoredRun::prove(std::int64_t step, const ReplayWatcher& watcher) {
    if (proven_ || !threads_) return;
    for (std::size_t k = moments().size(); k-- > 0;) {
        const State& moment = moments()[k];
        if (moment.step > step || !replayer().goes_to(moment.step)) continue;
        try {
            const State kept = grains(k);
            proven_ = same_grains(kept, replayer().at(moment.step, watcher).frame());
        } catch (const DamagedFrame&) {
            continue;
        }
        if (proven_) return;
        throw UserError(
            "{}: brought back to {:.6g} s it has other grains than in trajectory.nc: its checkpoints are of "
            "another run, or do not hold all of it; --no-replay takes what was kept",
            path().string(), moment.time);
    }
}

bool StoredRun::brings_back(std::int64_t step) const {
    return threads_ && !checkpoints().empty() && checkpoints().front().step <= step;
}

const std::vector<KeptCheckpoint>& StoredRun::checkpoints() const {
    if (checkpoints_) return checkpoints_->own;
    checkpoints_.emplace();
    std::error_code error;
    if (is_folder_)
        checkpoints_->own = own_checkpoints(path(), scene_, checkpoints_->news);
    else if (is_checkpoint(path()))
        checkpoints_->own = {{moments().front().step, path(), fs::file_size(path(), error)}};
    return checkpoints_->own;
}

const std::vector<std::string>& StoredRun::checkpoint_news() const {
    checkpoints();
    return checkpoints_->news;
}

void StoredRun::check_all() {
    if (!is_folder_) return;
    std::vector<std::size_t> damaged, places;
    std::string first;
    for (std::size_t k = 0; k < moments().size(); ++k) {
        try {
            const State frame = grains(k);
            if (measures_) check_measures_at(scene_, *measures_, frame, name_of("measures.csv"));
            if (contacts_) contacts_->touches(place(k));
            whole_contacts_[place(k)] = true;
        } catch (const DamagedFrame& error) {
            if (damaged.empty()) first = error.what();
            damaged.push_back(k);
            places.push_back(place(k));
        }
    }
    if (damaged.empty()) return;
    if (damaged.size() == moments().size()) throw UserError("{} (and no other frame is whole)", first);
    leave_out(damaged);
    faults_.push_back(damage_line(first, places));
}

void StoredRun::leave_out(const std::vector<std::size_t>& indices) {
    std::vector<State> moments;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < this->moments().size(); ++k) {
        if (std::binary_search(indices.begin(), indices.end(), k)) continue;
        moments.push_back(this->moments()[k]);
        numbers.push_back(number(k));
    }
    moments_ = std::move(moments);
    numbers_ = std::move(numbers);
    kept_.reset();
}

// A line about damaged frames. first: what is wrong with the first of them. places: their numbers.
std::string StoredRun::damage_line(const std::string& first, const std::vector<std::size_t>& places) const {
    constexpr std::size_t named = 5;
    const char* const what = brings_all_back() ? "brought back" : "left out";
    if (places.size() == 1) return fmt::format("{}; it is {}", first, what);
    const auto end = places.begin() + static_cast<std::ptrdiff_t>(std::min(places.size(), named));
    return fmt::format("{}; {} frames are {}: {}{}", first, places.size(), what,
                       fmt::join(places.begin(), end, ", "), places.size() > named ? " ..." : "");
}

std::vector<std::string> StoredRun::all_news() const {
    std::vector<std::string> lines = news();
    for (std::string& line : faults())
        if (!contains(lines, line)) lines.push_back(std::move(line));
    return lines;
}

std::vector<Link> touches_of(const SimulatedBed& run) {
    std::vector<Link> touches;
    for (const SavedContact& one : run.contacts()) touches.push_back({one.first, one.second, one.normal});
    return touches;
}

}  // namespace grainreel
