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
    if (run.frames().measures()) measured_ = MeasuredPeriods(*run.frames().measures());
}

void FilmOfRun::read_film_times() {
    const auto table = read_measures(run_.frames().folder() / kFilmTimes);
    if (!table) return;
    for (const double step : table->all("step"))
        if (std::isfinite(step)) filmed_.insert(std::llround(step));
}

int FilmOfRun::periods_at(std::int64_t step) const {
    const bool fixed = run_.scene().film.periods > 0 || !same_ || measured_.rows().empty();
    return fixed ? run_.frames().periods() : measured_.at(step);
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

std::vector<Shot> FilmOfRun::shots() const {
    const FilmedScene& scene = run_.scene();
    const Clock& clock = run_.clock();
    if (clock.step <= 0) return {{last_, 0}};  // the run has a single moment
    const std::int64_t steps = std::llround(scene.run.duration / clock.step);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<Shot> shots = with_bed(shots_at(instants_of(scene, clock, steps), segments, clock, steps));
    const std::int64_t first = run_.moments().front().step;
    std::erase_if(shots, [&](const Shot& shot) { return shot.step < first || shot.step > last_; });
    return shots;
}

// The shots that the film shows, following the periods of the bed. Where the run's own film ended before the
// run did, later shots follow the periods that the bed had then.
std::vector<Shot> FilmOfRun::with_bed(const std::vector<Shot>& shots) const {
    FilmedScene scene = run_.scene();
    if (!same_) scene.film.periods = run_.frames().periods();
    const bool may_leave_out = true;
    BedPeriods bed(scene, run_.clock(), shots, may_leave_out);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    const std::vector<MeasuredPeriods::Row>& rows = measured_.rows();
    std::vector<Shot> kept;
    std::size_t row = 0;
    for (const Shot& shot : shots) {
        for (; row < rows.size() && rows[row].step <= static_cast<double>(shot.step); ++row)
            bed.note(static_cast<std::int64_t>(rows[row].step), rows[row].periods, rows[row].difference);
        const bool told = !filmed_.empty() && shot.step <= *filmed_.rbegin();
        const bool shows = told ? filmed_.count(shot.step) > 0
                                : bed.shows(segments.at(static_cast<std::size_t>(shot.segment)), shot);
        if (shows) kept.push_back(shot);
    }
    return kept;
}

FilmOfRun::Place FilmOfRun::place_of(std::int64_t step) const {
    const std::vector<Shot> all = shots();
    const auto after =
        std::upper_bound(all.begin(), all.end(), step,
                         [](std::int64_t wanted, const Shot& shot) { return wanted < shot.step; });
    if (after == all.begin()) return {};
    const Shot& before = *std::prev(after);
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
    if (reachable_.brings_all_back()) return;
    run_.do_without_others();
    reachable_.look_again();
}

void RevisitedRun::leave_out_damaged() {
    run_.leave_out_damaged(reachable_.brings_all_back());
    reachable_.look_again();
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
    const std::vector<Shot> shots = shots_of(pictures);
    return std::all_of(shots.begin(), shots.end(), [&](const Shot& shot) { return has(shot.step); });
}

std::int64_t RevisitedRun::shown(std::int64_t step) const {
    return has(step) ? step : reachable_.nearest_kept(step, wants_touches());
}

std::vector<Shot> RevisitedRun::shown_shots(std::int64_t after) const {
    std::vector<Shot> shots;
    for (const Shot& shot : film_.shots()) {
        const std::int64_t step = shown(shot.step);
        if (step > (shots.empty() ? after : shots.back().step)) shots.push_back({step, shot.segment});
    }
    return shots;
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
    const FrameSupply kept = run_.frames().supply();
    return {any, any || kept.contacts, kept.measures, kept.orientations};
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

std::vector<Shot> RevisitedRun::shots_of(const Pictures& pictures) const {
    if (clock().step > 0) return shots_at(pictures.instants, pictures.segments, clock(), film_.last_step());
    std::vector<Shot> shots;  // shots of a run with one moment
    for (const Instant& instant : pictures.instants) shots.push_back({film_.last_step(), instant.segment});
    return shots;
}

std::vector<Frame> RevisitedRun::moments(const Pictures& pictures) const {
    std::vector<Frame> moments;
    for (const Shot& shot : shots_of(pictures)) moments.push_back(film_.moment(shown(shot.step)));
    return moments;
}

void RevisitedRun::start(const Pictures& pictures) {
    start(shots_of(pictures), pictures.segments);
}

void RevisitedRun::start(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments) {
    shots_ = shots;
    segments_ = segments;
    next_ = 0;
    kept_ = {};
    for (Shot& shot : shots_) {
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
    const Shot shot = shots_[next_++];
    if (!keep_moments_until(shot.step, go_on)) return std::nullopt;
    std::optional<ReachableMoments::Found> found = take(shot.step, wants_touches(), go_on);
    if (!found) return std::nullopt;
    brought_back_ = found->brought_back ? std::optional(shot.step) : std::nullopt;
    const int periods = film_.periods_at(shot.step);
    Frame& frame = found->frame;
    run_.parts().add(frame, segments_.at(static_cast<std::size_t>(shot.segment)), periods, *this);
    const bool again = next_ < shots_.size() && shots_[next_].step == shot.step;
    if (!again) kept_.done_with(shot.step);
    return Taken{std::make_shared<const Frame>(std::move(frame)), shot.segment, periods};
}

FramePtr RevisitedRun::at(std::int64_t step) const {
    FramePtr kept = kept_.at(step);
    return kept ? kept : run_.of_parts().at(step);
}

std::vector<Touch> RevisitedRun::touches(const Frame& frame) const {
    return brought_back_ == frame.step ? frame.touches : run_.of_parts().touches(frame);
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
