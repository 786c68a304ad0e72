#include "render/film/sources/film_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "engine/files/measures_csv.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

FilmSchedule::FilmSchedule(const StoredRun& run, const FilmedScene& scene, const Assignments& sets)
    : run_(run), scene_(scene), last_(run.last_step()) {
    if (!sets.empty()) {
        const Film &now = scene.film, then = scene_of_run(run.path(), {}).film;
        same_ = now.segments == then.segments && now.rate == then.rate && now.periods == then.periods;
    }
    if (same_) read_film_times();
    same_ = !filmed_.empty();
    if (run.measures()) measured_ = MeasuredPeriods(*run.measures());
}

void FilmSchedule::read_film_times() {
    const auto table = read_measures(run_.path() / kFilmTimes);
    if (!table) return;
    for (const double step : table->all("step"))
        if (std::isfinite(step)) filmed_.insert(std::llround(step));
}

int FilmSchedule::periods_at(std::int64_t step) const {
    const bool fixed = scene_.film.periods > 0 || !same_ || measured_.rows().empty();
    return fixed ? run_.periods() : measured_.at(step);
}

State FilmSchedule::moment(std::int64_t step) const {
    const Clock& clock = run_.clock();
    State moment;
    moment.step = step;
    moment.time = clock.step > 0 ? clock.time(step) : run_.to();
    moment.cycles = clock.cycles(step);
    moment.phase = clock.phase(step);
    return moment;
}

std::vector<Due> FilmSchedule::shots() const {
    const Clock& clock = run_.clock();
    if (clock.step <= 0) return {{last_, 0}};  // the run has a single moment
    const std::int64_t steps = std::llround(scene_.run.duration / clock.step);
    const std::vector<FilmSegment> segments = segments_of(scene_.film);
    std::vector<Due> shots = with_bed(shots_at(instants_of(scene_, clock, steps), segments, clock, steps));
    const std::int64_t first = run_.moments().front().step;
    std::erase_if(shots, [&](const Due& shot) { return shot.step < first || shot.step > last_; });
    return shots;
}

// The shots that the film shows, following the periods of the bed. Where the run's own film ended before the
// run did, later shots follow the periods that the bed had then.
std::vector<Due> FilmSchedule::with_bed(const std::vector<Due>& shots) const {
    FilmedScene scene = scene_;
    if (!same_) scene.film.periods = run_.periods();
    const bool may_leave_out = true;
    PeriodChoice bed(scene, run_.clock(), shots, may_leave_out);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    const std::vector<MeasuredPeriods::Row>& rows = measured_.rows();
    std::vector<Due> kept;
    std::size_t row = 0;
    for (const Due& shot : shots) {
        for (; row < rows.size() && rows[row].step <= static_cast<double>(shot.step); ++row)
            bed.note(static_cast<std::int64_t>(rows[row].step), rows[row].periods, rows[row].difference);
        const bool told = !filmed_.empty() && shot.step <= *filmed_.rbegin();
        const bool shows = told ? filmed_.count(shot.step) > 0
                                : bed.shows(segments.at(static_cast<std::size_t>(shot.segment)), shot);
        if (shows) kept.push_back(shot);
    }
    return kept;
}

FilmSchedule::Place FilmSchedule::place_of(std::int64_t step) const {
    const std::vector<Due> all = shots();
    const auto after =
        std::upper_bound(all.begin(), all.end(), step,
                         [](std::int64_t wanted, const Due& shot) { return wanted < shot.step; });
    if (after == all.begin()) return {};
    const Due& before = *std::prev(after);
    double pictures = static_cast<double>(after - all.begin()) - 1;
    if (after != all.end() && before.step < step)
        pictures += static_cast<double>(step - before.step) / static_cast<double>(after->step - before.step);
    return {before.segment, pictures / scene_.film.rate};
}

}  // namespace grainreel
