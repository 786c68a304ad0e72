// A scene that is being run, as a source of pictures: the frames that its driver hands out, with all that the
// film shows besides the grains.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/wear_file.hpp"
#include "engine/run/driver/run_driver.hpp"
#include "render/film/sources/period_choice.hpp"
#include "render/film/sources/picture_parts.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class LiveShots final : public ShotSource {
  public:
    // scene: the driver's scene with its film. The driver must outlive this object.
    LiveShots(const FilmedScene& scene, RunDriver& driver) : scene_(scene), driver_(driver) {}

    // Has the run keep its key moments (engine/run/driver/agenda.hpp) with their contacts. To be called
    // before start(). A resumed run keeps them if it did so before it was broken off, and not otherwise.
    void keep_key_moments() { keys_wanted_ = true; }
    // Closes the files of the run's folder that it reads. Nothing else may be called afterwards.
    void close() {
        earlier_.reset();
        wear_before_.reset();
    }

    const FilmedScene& scene() const override { return scene_; }
    bool has_any_moment() const override { return true; }
    Span span() const override;
    std::vector<State> moments(const Pictures& pictures) const override;
    // To be called after packing. Pictures before the run's first step are not given.
    void start(const Pictures& pictures) override;
    std::optional<Taken> next(const GoOn& go_on) override;
    // The driver's news, and what was found so far about the bed's periods.
    std::vector<std::string> news() const override;

    std::int64_t shots() const { return count_; }  // the number of pictures, or an upper limit of it
    // Whether there are pictures at all.
    bool has_shots(const Pictures& pictures) const { return !shots_of(pictures).empty(); }

  private:
    std::vector<Due> shots_of(const Pictures& pictures) const;
    FilmWishes wishes();
    KeptStates wanted_moments() const;
    std::optional<Taken> waiting();  // the next picture of the frame that was taken last
    // The shots of that step that the film shows, by what is known so far of the bed's periods.
    std::vector<Due> due_at(std::int64_t step) const;
    // What lies beside the frame that the driver has now.
    Beside beside_now(double time) const;
    void read_earlier();
    Taken next_earlier();
    StatePtr filed(std::int64_t step) const;
    void recall_bed_periods();
    void look_at_bed_periods(const SimulatedBed& simulation);
    void look_at_wear(const SimulatedBed& simulation);
    void read_wear_before();
    const FilmSegment& rule(int segment) const { return segments_.at(static_cast<std::size_t>(segment)); }

    const FilmedScene scene_;
    RunDriver& driver_;
    bool keys_wanted_ = false;
    std::vector<FilmSegment> segments_;  // segments of the film
    std::vector<Due> shots_;
    std::int64_t count_ = 0;
    std::optional<PeriodChoice> bed_periods_;
    std::optional<PictureParts> parts_;
    std::shared_ptr<const WearReader> wear_before_;  // reads the wear of a resumed run up to its break
    // Pressure and wear of each mesh, as in the last record of fields.nc that has ended.
    std::shared_ptr<const std::vector<MeshWear>> worn_;
    // The pictures that the film of a resumed run had before the run was broken off.
    struct Earlier {
        std::unique_ptr<StateArchive> moments;
        std::size_t next = 0;       // index of the next picture's moment
        std::vector<double> steps;  // of the rows of measures.csv
        MeasuredPeriods periods;
    };
    std::optional<Earlier> earlier_;
    ShotPtr frame_;             // the frame that was taken last
    std::vector<Due> waiting_;  // its pictures that are still to come
};

}  // namespace grainreel
