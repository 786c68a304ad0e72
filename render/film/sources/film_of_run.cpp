#include "render/film/sources/film_of_run.hpp"

#include <algorithm>
#include <cmath>

#include "engine/files/frames/same_run.hpp"
#include "engine/files/measures_csv.hpp"
#include "render/film/moments/film_times_table.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/bed_periods.hpp"
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

std::vector<Shot> FilmOfRun::shots() const {
    const FilmedScene& scene = run_.scene();
    const Clock& clock = run_.clock();
    if (clock.step <= 0) return {{last_, 0}};  // a single moment
    const std::int64_t steps = std::llround(scene.run.duration / clock.step);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<Shot> shots = with_bed(shots_at(instants_of(scene, clock, steps), segments, clock, steps));
    const std::int64_t first = run_.moments().front().step;
    std::erase_if(shots, [&](const Shot& shot) { return shot.step < first || shot.step > last_; });
    return shots;
}

// Where a film was cut off before its run, its later part is as the bed was then.
std::vector<Shot> FilmOfRun::with_bed(const std::vector<Shot>& shots) const {
    FilmedScene scene = run_.scene();
    if (!same_) scene.film.periods = run_.frames().periods();
    const bool may_leave_out = true;
    BedPeriods bed(scene, run_.clock(), shots, may_leave_out);
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<Shot> kept;
    std::size_t row = 0;
    for (const Shot& shot : shots) {
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

}  // namespace grainreel
