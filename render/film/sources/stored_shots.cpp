#include "render/film/sources/stored_shots.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "engine/base/team.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "render/film/sources/film_needs.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

// Threads of an engine that works beside a film.
int engine_threads(const FilmedScene& scene, int sharers) {
    const int wanted = scene.run.threads, processors = wanted > 0 ? wanted : usable_processors();
    return std::max(1, plan_threads(processors, true, scene.grains()).engine / sharers);
}

StoredRunRequest request_for(const FilmedScene& scene, bool replay, int sharers) {
    StoredRunRequest request;
    request.scene_of_run = [&scene](const std::filesystem::path&) -> Scene { return scene; };
    if (replay) request.threads = engine_threads(scene, sharers);
    request.contacts = needs_touches(scene.film.shows);
    return request;
}

// The run as the film takes it. Fits the scene's film to the run.
std::vector<std::string> fitted(FilmedScene& scene, StoredRun& run) {
    if (scene.film.periods > 0) run.set_periods(scene.film.periods);
    return do_without(scene, run);
}

}  // namespace

StoredShots::StoredShots(const std::filesystem::path& folder, const Assignments& sets, bool replay,
                         int sharers)
    : scene_(scene_of_run(folder_of_run(folder), sets)),
      run_(folder, request_for(scene_, replay, sharers)),
      replay_(replay),
      lacks_(fitted(scene_, run_)),
      parts_(scene_, run_.clock(), run_.moments().front().step),
      film_(run_, scene_, sets) {
    if (needs_measures(scene_.film) && run_.measures()) measured_ = run_.measures()->all("time_s");
}

// An exposure and a mean want moments between the pictures, which no run keeps. Without checkpoints they are
// left out, and single_moment_warnings() tells the user so with the place in the scene.
std::vector<FilmSegment> StoredShots::segments() const {
    std::vector<FilmSegment> segments = segments_of(scene_.film);
    return run_.brings_all_back() ? segments : of_single_moments(std::move(segments));
}

bool StoredShots::has_all(const Pictures& pictures) const {
    const std::vector<Due> shots = shots_of(pictures);
    return std::all_of(shots.begin(), shots.end(), [&](const Due& shot) { return has(shot.step); });
}

std::int64_t StoredShots::shown(std::int64_t step) const {
    return has(step) ? step : run_.kept().nearest_step(step, wants_touches());
}

std::vector<Due> StoredShots::shown_shots(std::int64_t after) const {
    std::vector<Due> shots;
    for (const Due& shot : film_.shots()) {
        const std::int64_t step = shown(shot.step);
        if (step > (shots.empty() ? after : shots.back().step)) shots.push_back({step, shot.segment});
    }
    return shots;
}

std::string StoredShots::why_not_all() const {
    if (run_.brings_all_back()) return "";
    if (!replay_) return "--no-replay: nothing is brought back";
    return fmt::format("{}: has no checkpoint{} from which moments can be brought back", run_.path().string(),
                       run_.checkpoints().empty()
                           ? ""
                           : fmt::format(" before {:.6g} s", clock().time(run_.checkpoints().front().step)));
}

Span StoredShots::span() const {
    const double to = clock().step > 0 ? clock().time(film_.last_step()) : run_.to();
    return {run_.from(), std::max(run_.to(), to)};
}

std::vector<std::string> StoredShots::news() const {
    std::vector<std::string> news = run_.news();
    const auto add = [&](const std::vector<std::string>& lines) {
        news.insert(news.end(), lines.begin(), lines.end());
    };
    add(lacks_);
    if (replay_) add(run_.checkpoint_news());
    for (const KeptList::Fault& fault : run_.kept().faults_of_film())
        news.push_back(fault.what + "; it is not used");
    return news;
}

std::vector<Due> StoredShots::shots_of(const Pictures& pictures) const {
    if (clock().step > 0) return shots_at(pictures.instants, pictures.segments, clock(), film_.last_step());
    std::vector<Due> shots;  // shots of a run with one moment
    for (const Instant& instant : pictures.instants) shots.push_back({film_.last_step(), instant.segment});
    return shots;
}

std::vector<State> StoredShots::moments(const Pictures& pictures) const {
    std::vector<State> moments;
    for (const Due& shot : shots_of(pictures)) moments.push_back(film_.moment(shown(shot.step)));
    return moments;
}

void StoredShots::start(const Pictures& pictures) {
    start(shots_of(pictures), pictures.segments);
}

void StoredShots::start(const std::vector<Due>& shots, const std::vector<FilmSegment>& segments) {
    shots_ = shots;
    segments_ = segments;
    next_ = 0;
    earlier_ = {};
    for (Due& shot : shots_) {
        shot.step = shown(shot.step);
        const FilmSegment& rule = segments_.at(static_cast<std::size_t>(shot.segment));
        earlier_.want(shot.step, parts_.moments(shot.step, rule, film_.periods_at(shot.step)));
    }
    wanted_ = earlier_.steps();
}

std::optional<StoredMoment> StoredShots::take(std::int64_t step, bool touches, const GoOn& go_on) {
    return run_.at(step, touches, [&](double done) { return go_on() && (!watcher_ || watcher_(done)); });
}

StatePtr StoredShots::grains(std::int64_t step, const GoOn& go_on) {
    std::optional<StoredMoment> moment = take(step, false, go_on);
    return moment ? std::make_shared<const State>(std::move(moment->frame)) : nullptr;
}

// Keeps the wanted moments up to `step`. Pictures do without moments that cannot be had.
bool StoredShots::keep_moments_until(std::int64_t step, const GoOn& go_on) {
    while (!wanted_.empty() && *wanted_.begin() <= step) {
        const std::int64_t one = *wanted_.begin();
        wanted_.erase(wanted_.begin());
        if (run_.origin_of(one, false) == Origin::nowhere) continue;
        const std::optional<StoredMoment> moment = take(one, false, go_on);
        if (!moment) return false;
        earlier_.keep(moment->frame);
    }
    return true;
}

std::optional<Taken> StoredShots::next(const GoOn& go_on) {
    if (!go_on() || next_ == shots_.size()) return std::nullopt;
    const Due due = shots_[next_++];
    if (!keep_moments_until(due.step, go_on)) return std::nullopt;
    std::optional<StoredMoment> moment = take(due.step, wants_touches(), go_on);
    if (!moment) return std::nullopt;
    const int periods = film_.periods_at(due.step);
    Shot shot(std::move(moment->frame));
    parts_.add(shot, segments_.at(static_cast<std::size_t>(due.segment)), periods,
               beside(shot.time, std::move(moment->touches)), [&](std::int64_t step) {
                   StatePtr kept = earlier_.at(step);
                   return kept ? kept : earlier(step);
               });
    const bool again = next_ < shots_.size() && shots_[next_].step == due.step;
    if (!again) earlier_.done_with(due.step);
    return Taken{std::make_shared<const Shot>(std::move(shot)), due.segment, periods};
}

// A moment of the trajectory, for displacements; null where there is none at that step.
StatePtr StoredShots::earlier(std::int64_t step) const {
    const std::optional<std::size_t> index = run_.index_near(clock().time(step));
    return index ? std::make_shared<const State>(run_.grains(*index)) : nullptr;
}

Beside StoredShots::beside(double time, std::optional<std::vector<Link>> touches) const {
    Beside all;
    all.touches = std::move(touches).value_or(std::vector<Link>());
    if (needs_measures(scene_.film)) {
        const double end = time * (1 + 1e-9) + 1e-12;
        all.measures = run_.measures();
        all.measure_rows = static_cast<std::size_t>(
            std::upper_bound(measured_.begin(), measured_.end(), end) - measured_.begin());
    }
    if (shows_wear(scene_)) all.worn = run_.worn(time);
    if (scene_.film.shows.outflow) all.flowed_out = run_.flowed_out(time);
    return all;
}

}  // namespace grainreel
