// A scene that is being run, as a source of pictures: what its driver hands out, with all that the film shows
// beside the grains.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/wear_file.hpp"
#include "engine/run/driver/run_driver.hpp"
#include "render/film/sources/bed_periods.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/film/sources/picture_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SceneRun final : public FrameSource {
  public:
    // scene: that of the driver, with its film. The driver must outlive this.
    SceneRun(const FilmedScene& scene, RunDriver& driver) : scene_(scene), driver_(driver) {}

    // Before start(): key moments are kept with their contacts. A run that goes on does what it did.
    void keep_key_moments() { keys_wanted_ = true; }
    // Closes what it reads of the run's folder. Nothing else may be called afterwards.
    void close() {
        earlier_.reset();
        wear_before_.reset();
    }

    const FilmedScene& scene() const override { return scene_; }
    Supply supply() const override { return {true, true, true, scene_.keeps_orientations()}; }
    Span span() const override;
    std::vector<Frame> moments(const Pictures& pictures) const override;
    // After packing. Pictures before the run's first step do not come.
    void start(const Pictures& pictures) override;
    std::optional<Taken> next(const GoOn& go_on) override;
    // The driver's news, and what was found of the bed's periods so far.
    std::vector<std::string> news() const override;

    std::int64_t shots() const { return count_; }  // pictures that come, at most
    // Whether there are pictures at all.
    bool has_shots(const Pictures& pictures) const { return !shots_of(pictures).empty(); }

  private:
    class Parts;  // what it has for pictures

    std::vector<Shot> shots_of(const Pictures& pictures) const;
    FrameWishes wishes();
    KeptMoments wanted_moments() const;
    std::optional<Taken> waiting();  // another picture of the frame taken last
    // Whether the film, by now, shows none of the pictures of that step. Notes those that it shows.
    bool leaves_out(std::int64_t step);
    void look_at_bed_periods(const Simulation& simulation);
    void look_at_wear(const Simulation& simulation);
    void read_wear_before();
    const FilmSegment& rule(int segment) const { return segments_.at(static_cast<std::size_t>(segment)); }

    const FilmedScene scene_;
    RunDriver& driver_;
    bool keys_wanted_ = false;
    std::vector<FilmSegment> segments_;  // of the film
    std::vector<Shot> shots_;
    std::int64_t count_ = 0;
    std::optional<BedPeriods> bed_periods_;
    std::optional<PictureParts> parts_;
    std::shared_ptr<const WearReader> wear_before_;      // of a run that goes on
    std::shared_ptr<const std::vector<MeshWear>> worn_;  // since the last record of fields.nc ended
    std::optional<EarlierPictures> earlier_;
    FramePtr frame_;                     // taken last
    std::vector<int> segments_waiting_;  // of its pictures that are yet to come
};

}  // namespace grainreel
