#include "render/film/sources/revisited_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/measures_csv.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/bed_periods.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::vector<double> column_or_none(const MeasureTable& table, const char* name) {
    const std::optional<std::size_t> column = column_of(table, name);
    return column ? table.values(*column, 0, table.rows()) : std::vector<double>();
}

}  // namespace

FilmOfRun::FilmOfRun(const RecordedRun& run, const Assignments& sets) : run_(run) {
    last_ = run.moments().back().step;
    if (const std::vector<KeptCheckpoint> kept = run.record().checkpoints(); !kept.empty())
        last_ = std::max(last_, kept.back().step);
    if (!sets.empty()) {
        const Film &now = run.scene().film, then = scene_of_run(run.frames().folder(), {}).film;
        same_ = now.segments == then.segments && now.rate == then.rate && now.periods == then.periods;
    }
    if (same_) read_film_times();
    same_ = !filmed_.empty();
    read_periods();
}

void FilmOfRun::read_film_times() {
    const auto table = read_measures(run_.frames().folder() / kFilmTimes);
    if (!table) return;
    for (const double step : column_or_none(*table, "step"))
        if (std::isfinite(step)) filmed_.insert(std::llround(step));
}

void FilmOfRun::read_periods() {
    if (!run_.frames().measures()) return;
    steps_ = column_or_none(*run_.frames().measures(), "step");
    periods_ = column_or_none(*run_.frames().measures(), "bed_periods");
    differences_ = column_or_none(*run_.frames().measures(), "period_difference_m");
    if (periods_.size() != steps_.size() || differences_.size() != steps_.size()) steps_.clear();
}

int FilmOfRun::periods_at(std::int64_t step) const {
    if (run_.scene().film.periods > 0 || !same_ || steps_.empty()) return run_.frames().periods();
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), static_cast<double>(step));
    if (after == steps_.begin()) return 1;
    return std::max(1, static_cast<int>(periods_[static_cast<std::size_t>(after - steps_.begin()) - 1]));
}

Frame FilmOfRun::moment(std::int64_t step) const {
    const Clock& clock = run_.clock();
    Frame moment;
    moment.step = step;
    moment.time = clock.step > 0 ? clock.time(step) : run_.span().to;
    moment.cycles = clock.cycles(step);
    moment.phase = clock.phase(step);
    return moment;
}

std::vector<Due> FilmOfRun::shots() const {
    const FilmedScene& scene = run_.scene();
    const Clock& clock = run_.clock();
    if (clock.step <= 0) return {{last_, 0}};  // the run has a single moment
    const std::int64_t steps = std::llround(scene.run.duration / clock.step);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<Due> shots = with_bed(shots_at(instants_of(scene, clock, steps), segments, clock, steps));
    const std::int64_t first = run_.moments().front().step;
    std::erase_if(shots, [&](const Due& shot) { return shot.step < first || shot.step > last_; });
    return shots;
}

// The shots that the film shows, following the periods of the bed. Where the run's own film ended before the
// run did, later shots follow the periods that the bed had then.
std::vector<Due> FilmOfRun::with_bed(const std::vector<Due>& shots) const {
    FilmedScene scene = run_.scene();
    if (!same_) scene.film.periods = run_.frames().periods();
    const bool may_leave_out = true;
    BedPeriods bed(scene, run_.clock(), shots, may_leave_out);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<Due> kept;
    std::size_t row = 0;
    for (const Due& shot : shots) {
        for (; row < steps_.size() && steps_[row] <= static_cast<double>(shot.step); ++row)
            bed.note(static_cast<std::int64_t>(steps_[row]), static_cast<int>(periods_[row]),
                     differences_[row]);
        const bool told = !filmed_.empty() && shot.step <= *filmed_.rbegin();
        const bool shows = told ? filmed_.count(shot.step) > 0
                                : bed.shows(segments.at(static_cast<std::size_t>(shot.segment)), shot);
        if (shows) kept.push_back(shot);
    }
    return kept;
}

FilmOfRun::Place FilmOfRun::place_of(std::int64_t step) const {
    const std::vector<Due> all = shots();
    const auto after =
        std::upper_bound(all.begin(), all.end(), step,
                         [](std::int64_t wanted, const Due& shot) { return wanted < shot.step; });
    if (after == all.begin()) return {};
    const Due& before = *std::prev(after);
    double pictures = static_cast<double>(after - all.begin()) - 1;
    if (after != all.end() && before.step < step)
        pictures += static_cast<double>(step - before.step) / static_cast<double>(after->step - before.step);
    return {before.segment, pictures / run_.scene().film.rate};
}

namespace {

// Threads of an engine that works beside a film.
int engine_threads(const FilmedScene& scene, int sharers) {
    const int wanted = scene.run.threads, processors = wanted > 0 ? wanted : usable_processors();
    return std::max(1, plan_threads(processors, true, scene.grains()).engine / sharers);
}

}  // namespace

RevisitedRun::RevisitedRun(const std::filesystem::path& folder, const Assignments& sets, bool replay,
                           int sharers)
    : run_(folder, sets, RecordedRun::Use{.for_questions = false, .alone = false}),
      replay_(replay),
      reachable_(run_.record(), replay ? engine_threads(run_.scene(), sharers) : 0),
      film_(run_, sets) {
    if (!reachable_.brings_all_back()) run_.do_without_others();
}

void RevisitedRun::leave_out_damaged() {
    run_.leave_out_damaged(reachable_.brings_all_back());
}

bool RevisitedRun::wants_touches() const {
    return needs_touches(scene().film.shows);
}

// An exposure and a mean want moments between the pictures, which no run keeps. Without checkpoints they are
// left out, and single_moment_warnings() tells the user so with the place in the scene.
std::vector<FilmSegment> RevisitedRun::segments() const {
    std::vector<FilmSegment> segments = segments_of(scene().film);
    return reachable_.brings_all_back() ? segments : of_single_moments(std::move(segments));
}

bool RevisitedRun::has(std::int64_t step) const {
    return reachable_.place_of(step, wants_touches()) != ReachableMoments::Place::nowhere;
}

bool RevisitedRun::has_all(const Pictures& pictures) const {
    const std::vector<Due> shots = shots_of(pictures);
    return std::all_of(shots.begin(), shots.end(), [&](const Due& shot) { return has(shot.step); });
}

std::int64_t RevisitedRun::shown(std::int64_t step) const {
    return has(step) ? step : reachable_.nearest_kept(step, wants_touches());
}

bool RevisitedRun::is_brought_back(std::int64_t step) const {
    return reachable_.place_of(step, wants_touches()) == ReachableMoments::Place::checkpoints;
}

std::string RevisitedRun::why_not_all() const {
    if (reachable_.brings_all_back()) return "";
    if (!replay_) return "--no-replay: nothing is brought back";
    return fmt::format(
        "{}: has no checkpoint{} from which moments can be brought back", run_.frames().folder().string(),
        run_.record().checkpoints().empty()
            ? ""
            : fmt::format(" before {:.6g} s", clock().time(run_.record().checkpoints().front().step)));
}

Supply RevisitedRun::supply() const {
    const bool any = reachable_.brings_all_back();
    return {any, any || run_.supply().contacts, run_.supply().measures, run_.supply().orientations};
}

Span RevisitedRun::span() const {
    const double to = clock().step > 0 ? clock().time(film_.last_step()) : run_.span().to;
    return {run_.span().from, std::max(run_.span().to, to)};
}

std::vector<std::string> RevisitedRun::news() const {
    std::vector<std::string> news = run_.news();
    if (replay_)
        for (std::string& line : run_.record().checkpoint_news()) news.push_back(std::move(line));
    news.insert(news.end(), reachable_.news().begin(), reachable_.news().end());
    return news;
}

std::vector<Due> RevisitedRun::shots_of(const Pictures& pictures) const {
    if (clock().step > 0) return shots_at(pictures.instants, pictures.segments, clock(), film_.last_step());
    std::vector<Due> shots;  // shots of a run with one moment
    for (const Instant& instant : pictures.instants) shots.push_back({film_.last_step(), instant.segment});
    return shots;
}

std::vector<Frame> RevisitedRun::moments(const Pictures& pictures) const {
    std::vector<Frame> moments;
    for (const Due& shot : shots_of(pictures)) moments.push_back(film_.moment(shown(shot.step)));
    return moments;
}

void RevisitedRun::start(const Pictures& pictures) {
    start(shots_of(pictures), pictures.segments);
}

void RevisitedRun::start(const std::vector<Due>& shots, const std::vector<FilmSegment>& segments) {
    shots_ = shots;
    segments_ = segments;
    next_ = 0;
    kept_ = {};
    for (Due& shot : shots_) {
        shot.step = shown(shot.step);
        const FilmSegment& rule = segments_.at(static_cast<std::size_t>(shot.segment));
        kept_.want(shot.step, run_.parts().moments(shot.step, rule, film_.periods_at(shot.step)));
    }
    wanted_ = kept_.steps();
}

std::optional<ReachableMoments::Found> RevisitedRun::take(std::int64_t step, bool touches,
                                                          const GoOn& go_on) {
    bool stopped = false;
    const auto watcher = [&](double done) {
        stopped = stopped || !go_on() || (watcher_ && !watcher_(done));
        return !stopped;
    };
    try {
        return reachable_.at(step, touches, watcher);
    } catch (const RunError&) {
        if (stopped) return std::nullopt;
        throw;
    }
}

FramePtr RevisitedRun::grains(std::int64_t step, const GoOn& go_on) {
    std::optional<ReachableMoments::Found> found = take(step, false, go_on);
    return found ? std::make_shared<const Frame>(std::move(found->frame)) : nullptr;
}

// Keeps the wanted moments up to `step`. Pictures do without moments that cannot be had.
bool RevisitedRun::keep_moments_until(std::int64_t step, const GoOn& go_on) {
    while (!wanted_.empty() && *wanted_.begin() <= step) {
        const std::int64_t one = *wanted_.begin();
        wanted_.erase(wanted_.begin());
        if (reachable_.place_of(one, false) == ReachableMoments::Place::nowhere) continue;
        const std::optional<ReachableMoments::Found> found = take(one, false, go_on);
        if (!found) return false;
        kept_.keep(found->frame);
    }
    return true;
}

std::optional<Taken> RevisitedRun::next(const GoOn& go_on) {
    if (!go_on() || next_ == shots_.size()) return std::nullopt;
    const Due due = shots_[next_++];
    if (!keep_moments_until(due.step, go_on)) return std::nullopt;
    std::optional<ReachableMoments::Found> found = take(due.step, wants_touches(), go_on);
    if (!found) return std::nullopt;
    brought_back_ = found->brought_back ? std::optional(due.step) : std::nullopt;
    touches_ = std::move(found->touches);
    const int periods = film_.periods_at(due.step);
    Shot shot(std::move(found->frame));
    run_.parts().add(shot, segments_.at(static_cast<std::size_t>(due.segment)), periods, *this);
    const bool again = next_ < shots_.size() && shots_[next_].step == due.step;
    if (!again) kept_.done_with(due.step);
    return Taken{std::make_shared<const Shot>(std::move(shot)), due.segment, periods};
}

FramePtr RevisitedRun::at(std::int64_t step) const {
    FramePtr kept = kept_.at(step);
    return kept ? kept : run_.of_parts().at(step);
}

std::vector<Touch> RevisitedRun::touches(const Frame& frame) const {
    return brought_back_ == frame.step ? touches_ : run_.of_parts().touches(frame);
}

PartSupply::Measured RevisitedRun::measured(const Frame& frame) const {
    return run_.of_parts().measured(frame);
}

std::optional<FlowedOut> RevisitedRun::flowed_out(const Frame& frame) const {
    return run_.of_parts().flowed_out(frame);
}

std::shared_ptr<const std::vector<MeshWear>> RevisitedRun::worn(const Frame& frame) const {
    return run_.of_parts().worn(frame);
}

}  // namespace grainreel
