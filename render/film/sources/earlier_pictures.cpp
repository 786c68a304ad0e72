#include "render/film/sources/earlier_pictures.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/state/wall_motion.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

EarlierPictures::EarlierPictures(const FilmedScene& scene, const Clock& clock,
                                 const std::filesystem::path& run, const std::vector<Shot>& shots,
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
    // One that is damaged is not among them, and the film would go on with another one in its place.
    if (next_ >= moments_->moments().size() || moments_->place(next_) != next_)
        throw UserError(moments_->damage().empty()
                            ? moments_->path().string() + ": lacks a picture that it has had"
                            : moments_->damage().front());
    Frame frame = moments_->grains(next_++);
    add_planes(scene_.walls, frame.time, frame.bodies);
    const auto shot = std::lower_bound(shots_.begin(), shots_.end(), frame.step,
                                       [](const Shot& one, std::int64_t step) { return one.step < step; });
    GRAINREEL_CHECK(shot != shots_.end() && shot->step == frame.step);
    const int periods = periods_at(frame.step);
    parts_.add(frame, scene_.film.segments.at(static_cast<std::size_t>(shot->segment)), periods, *this);
    return Taken{std::make_shared<const Frame>(std::move(frame)), shot->segment, periods};
}

std::size_t EarlierPictures::rows_until(std::int64_t step) const {
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), static_cast<double>(step));
    return static_cast<std::size_t>(after - steps_.begin());
}

PartSupply::Measured EarlierPictures::measured(const Frame& frame) const {
    return {measures_, rows_until(frame.step)};
}

// As the run had found them by then, or as the scene wants them.
int EarlierPictures::periods_at(std::int64_t step) const {
    if (scene_.film.periods > 0) return scene_.film.periods;
    const std::size_t rows = std::min(rows_until(step), periods_.size());
    return rows == 0 ? 1 : std::max(1, static_cast<int>(periods_[rows - 1]));
}

}  // namespace grainreel
