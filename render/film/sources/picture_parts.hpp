// PictureParts is the one place that adds to a shot what its picture shows besides the moment itself:
// displacements since an earlier period, the moments of an exposure, means over periods, contacts, measures
// for plots and live words, and what has flowed out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/wear_file.hpp"
#include "engine/frame.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/measure/measures.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What PictureParts asks a source for.
class PartSupply {
  public:
    struct Measured {
        std::shared_ptr<const MeasureTable> table;  // null for none
        std::size_t rows = 0;                       // number of rows up to the frame
    };

    virtual ~PartSupply() = default;
    // Grains and bodies at a step; null when they cannot be had.
    virtual FramePtr at(std::int64_t step) const = 0;
    // These tell what is known about the moment of the frame.
    virtual std::vector<Touch> touches(const Frame& frame) const = 0;
    virtual Measured measured(const Frame& frame) const = 0;
    // What the grains do to the meshes, one entry for each mesh; null when that is not known.
    virtual std::shared_ptr<const std::vector<MeshWear>> worn(const Frame&) const { return nullptr; }
    // What has left the run up to the frame; none when that is not known.
    virtual std::optional<FlowedOut> flowed_out(const Frame& frame) const = 0;
};

class PictureParts {
  public:
    // Only the film of the scene is used. first: the first step that can be had.
    PictureParts(const FilmedScene& scene, const Clock& clock, std::int64_t first);

    // The other moments that the picture at `step` needs, in no particular order; some may come twice. rule:
    // the segment by which the picture is taken. periods: number of periods after which the bed repeats
    // itself.
    std::vector<WantedMoment> moments(std::int64_t step, const FilmSegment& rule, int periods) const;

    // Adds the parts that the source can supply. A grain that is missing at an earlier moment gets no
    // displacement or no mean.
    void add(Shot& shot, const FilmSegment& rule, int periods, const PartSupply& supply) const;

  private:
    // Steps of the moments that displacements, the exposure and the mean need; empty when the picture has no
    // such part.
    std::vector<std::int64_t> earlier(std::int64_t step, int periods) const;
    std::vector<std::int64_t> exposed(std::int64_t step, const FilmSegment& rule, int periods) const;
    std::vector<std::int64_t> averaged(std::int64_t step, const FilmSegment& rule, int periods) const;
    void add_mean(Frame& frame, const FilmSegment& rule, int periods, const PartSupply& supply) const;

    FilmShows shows_;
    bool wear_;  // whether walls are coloured by wear
    Clock clock_;
    std::int64_t first_;
    double depth_;  // m, period of a periodic container along x; 0 for none
};

// Gives the pictures that the film of a resumed run had taken before the run was broken off, from the moments
// that were kept for them.
class EarlierPictures final : private PartSupply {
  public:
    // run: the run's folder. shots: those of the film. count: how many of the kept moments are pictures of
    // the film. measures: rows of the run, with the columns that the film shows; null if it shows none.
    // files: they tell what has flowed out. wear: for a film whose walls are coloured by wear, else null.
    EarlierPictures(const FilmedScene& scene, const Clock& clock, const std::filesystem::path& run,
                    const std::vector<Due>& shots, std::size_t count,
                    std::shared_ptr<const MeasureTable> measures, const RunFiles& files,
                    std::shared_ptr<const WearReader> wear);

    // Gives the next picture; empty after the last one.
    std::optional<Taken> next();

  private:
    FramePtr at(std::int64_t) const override { return nullptr; }
    std::vector<Touch> touches(const Frame&) const override { return {}; }
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override {
        return files_.flowed_out(frame.time);
    }
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame& frame) const override {
        return wear_ ? wear_->until(frame.time) : nullptr;
    }
    std::size_t rows_until(std::int64_t step) const;
    int periods_at(std::int64_t step) const;

    const FilmedScene& scene_;
    const RunFiles& files_;
    std::unique_ptr<FrameArchive> moments_;
    std::vector<Due> shots_;
    std::size_t count_, next_ = 0;
    std::shared_ptr<const MeasureTable> measures_;
    std::shared_ptr<const WearReader> wear_;
    std::vector<double> steps_, periods_;  // steps and bed periods of the rows of measures
    PictureParts parts_;
};

}  // namespace grainreel
