#include "render/film/sources/picture_parts.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/state/body.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/bed_periods.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

PictureParts::PictureParts(const FilmedScene& scene, const Clock& clock, std::int64_t first)
    : shows_(scene.film.shows),
      wear_(shows_wear(scene)),
      clock_(clock),
      first_(first),
      depth_(scene.container.periodic_depth ? scene.container.depth : 0) {}

std::vector<std::int64_t> PictureParts::earlier(std::int64_t step, int periods) const {
    if (!needs_displacement(shows_)) return {};
    const std::int64_t before = clock_.changes.empty() ? step - periods * clock_.steps_per_period
                                                       : clock_.step_at(clock_.cycles(step) - periods);
    if (before < first_) return {};
    return {before};
}

// Steps of the exposure. A picture near the run's beginning is exposed for a shorter time.
std::vector<std::int64_t> PictureParts::exposed(std::int64_t step, const FilmSegment& rule,
                                                int periods) const {
    std::vector<std::int64_t> over = exposed_steps({step, 0}, rule, clock_, periods);
    std::erase_if(over, [&](std::int64_t one) { return one < first_; });
    return over;
}

std::vector<std::int64_t> PictureParts::averaged(std::int64_t step, const FilmSegment& rule,
                                                 int periods) const {
    return averaged_steps({step, 0}, rule, clock_, periods);
}

std::vector<WantedMoment> PictureParts::moments(std::int64_t step, const FilmSegment& rule,
                                                int periods) const {
    std::vector<WantedMoment> all;
    for (const std::int64_t one : earlier(step, periods)) all.push_back({one, false});
    for (const std::int64_t one : exposed(step, rule, periods)) all.push_back({one, true});
    for (const std::int64_t one : averaged(step, rule, periods))
        if (std::max(one, first_) != step) all.push_back({std::max(one, first_), false});
    return all;
}

void PictureParts::add(Shot& shot, const FilmSegment& rule, int periods, const PartSupply& supply) const {
    for (const std::int64_t step : earlier(shot.step, periods))
        if (const FramePtr before = supply.at(step))
            shot.displacement = displacement_since(*before, shot, periods, depth_);
    for (const std::int64_t step : exposed(shot.step, rule, periods))
        if (const FramePtr moment = supply.at(step))
            shot.exposed.push_back(std::make_shared<const Shot>(*moment));
    if (needs_touches(shows_)) shot.touches = supply.touches(shot);
    if (wear_) shot.worn = supply.worn(shot);
    if (shows_.outflow) shot.flowed_out = supply.flowed_out(shot);
    if (needs_measures(shows_)) {
        PartSupply::Measured measured = supply.measured(shot);
        shot.measures = std::move(measured.table);
        shot.measure_rows = measured.rows;
    }
    add_mean(shot, rule, periods, supply);
}

// Adds the mean. Before the run's first step the grains are taken to have been where they were at that step.
void PictureParts::add_mean(Frame& frame, const FilmSegment& rule, int periods,
                            const PartSupply& supply) const {
    const std::vector<std::int64_t> steps = averaged(frame.step, rule, periods);
    if (steps.empty()) return;
    const auto own = std::make_shared<const Frame>(places_of(frame));
    std::vector<FramePtr> moments;
    for (const std::int64_t step : steps) {
        const std::int64_t from = std::max(step, first_);
        moments.push_back(from == frame.step ? own : supply.at(from));
        if (!moments.back()) return;
    }
    set_mean(frame, moments, static_cast<double>(frame.step - steps.front()) * clock_.step, depth_);
}

EarlierPictures::EarlierPictures(const FilmedScene& scene, const Clock& clock,
                                 const std::filesystem::path& run, const std::vector<Due>& shots,
                                 std::size_t count, std::shared_ptr<const MeasureTable> measures,
                                 const RunFiles& files, std::shared_ptr<const WearReader> wear)
    : scene_(scene),
      files_(files),
      moments_(open_frames(run / kFilmMoments, {.format = "trajectory"})),
      shots_(shots),
      count_(count),
      measures_(std::move(measures)),
      wear_(std::move(wear)),
      parts_(scene, clock, 0) {
    const std::shared_ptr<const MeasureTable> rows = read_measures(run / "measures.csv");
    GRAINREEL_CHECK(rows != nullptr);
    const auto values = [&](const char* name) {
        const auto column = column_of(*rows, name);
        return column ? rows->values(*column, 0, rows->rows()) : std::vector<double>();
    };
    steps_ = values("step");
    periods_ = values("bed_periods");
}

std::optional<Taken> EarlierPictures::next() {
    if (next_ == count_) return std::nullopt;
    // If a moment is damaged, the list lacks it, and without this check another moment would take its place.
    if (next_ >= moments_->moments().size() || moments_->place(next_) != next_)
        throw UserError(moments_->damage().empty()
                            ? moments_->path().string() + ": lacks a picture that it has had"
                            : moments_->damage().front());
    Shot shot = moments_->grains(next_++);
    add_planes(scene_.walls, shot.time, shot.bodies);
    const auto due = std::lower_bound(shots_.begin(), shots_.end(), shot.step,
                                      [](const Due& one, std::int64_t step) { return one.step < step; });
    GRAINREEL_CHECK(due != shots_.end() && due->step == shot.step);
    const int periods = periods_at(shot.step);
    parts_.add(shot, scene_.film.segments.at(static_cast<std::size_t>(due->segment)), periods, *this);
    return Taken{std::make_shared<const Shot>(std::move(shot)), due->segment, periods};
}

std::size_t EarlierPictures::rows_until(std::int64_t step) const {
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), static_cast<double>(step));
    return static_cast<std::size_t>(after - steps_.begin());
}

PartSupply::Measured EarlierPictures::measured(const Frame& frame) const {
    return {measures_, rows_until(frame.step)};
}

// The periods that the run had found by that step, or the number that the scene sets.
int EarlierPictures::periods_at(std::int64_t step) const {
    if (scene_.film.periods > 0) return scene_.film.periods;
    const std::size_t rows = std::min(rows_until(step), periods_.size());
    return rows == 0 ? 1 : std::max(1, static_cast<int>(periods_[rows - 1]));
}

}  // namespace grainreel
