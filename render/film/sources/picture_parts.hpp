// The one place that adds to a frame what its picture shows beside the moment itself: ways since an earlier
// period, moments that it is exposed over, means of periods, contacts, measures for plots and live words, and
// what has flowed out.
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
#include "engine/measure/measures.hpp"
#include "engine/run/driver/kept_moments.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/scene/scene.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What a source has of its run.
class PartSupply {
  public:
    struct Measured {
        std::shared_ptr<const MeasureTable> table;  // null for none
        std::size_t rows = 0;                       // until the frame
    };

    virtual ~PartSupply() = default;
    // How grains and bodies were at a step; null when that is not to be had.
    virtual FramePtr at(std::int64_t step) const = 0;
    // What is known of the moment of the frame.
    virtual std::vector<Touch> touches(const Frame& frame) const = 0;
    virtual Measured measured(const Frame& frame) const = 0;
    // What the grains do to meshes, a mesh each; null when that is not known.
    virtual std::shared_ptr<const std::vector<MeshWear>> worn(const Frame&) const { return nullptr; }
    // What has left the run until the frame; none when that is not known.
    virtual std::optional<FlowedOut> flowed_out(const Frame& frame) const = 0;
};

class PictureParts {
  public:
    // What counts in the scene is its film. first: the first step that is to be had.
    PictureParts(const FilmedScene& scene, const Clock& clock, std::int64_t first);

    // The other moments that the picture at `step` is made of, in no order; some may come twice. rule: the
    // segment by which it is taken. periods: after which the bed repeats itself.
    std::vector<WantedMoment> moments(std::int64_t step, const FilmSegment& rule, int periods) const;

    // Adds what of all that is to be had. Where grains have come or gone in between, ways and means are left
    // out.
    void add(Frame& frame, const FilmSegment& rule, int periods, const PartSupply& supply) const;

  private:
    // Steps; empty where the picture has no such part.
    std::vector<std::int64_t> earlier(std::int64_t step, int periods) const;
    std::vector<std::int64_t> exposed(std::int64_t step, const FilmSegment& rule, int periods) const;
    std::vector<std::int64_t> averaged(std::int64_t step, const FilmSegment& rule, int periods) const;
    void add_mean(Frame& frame, const FilmSegment& rule, int periods, const PartSupply& supply) const;

    FilmShows shows_;
    bool wear_;  // whether walls have its colours
    Clock clock_;
    std::int64_t first_;
    double depth_;  // m, along x, after which a periodic container repeats; 0 for none
};

// Gives the pictures of a film that were taken before its run was broken off, from their kept moments.

class EarlierPictures final : private PartSupply {
  public:
    // run: folder; shots: of the film; count: how many of its kept moments are pictures of it. measures: rows
    // of the run, those of `shown` too; null without a film that shows any. files: know what has flowed out.
    // wear: of a film whose walls have its colours, else null.
    EarlierPictures(const FilmedScene& scene, const Clock& clock, const std::filesystem::path& run,
                    const std::vector<Shot>& shots, std::size_t count,
                    std::shared_ptr<const MeasureTable> measures, const RunFiles& files,
                    std::shared_ptr<const WearReader> wear);

    // Empty after the last.
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
    std::vector<Shot> shots_;
    std::size_t count_, next_ = 0;
    std::shared_ptr<const MeasureTable> measures_;
    std::shared_ptr<const WearReader> wear_;
    std::vector<double> steps_, periods_;  // of the rows
    PictureParts parts_;
};

}  // namespace grainreel
