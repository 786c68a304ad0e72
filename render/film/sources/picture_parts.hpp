// The one place that adds to a frame what its picture shows beside the moment itself: ways since an earlier
// period, moments that it is exposed over, means of periods, contacts, measures for plots and live words, and
// what has flowed out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/frame.hpp"
#include "engine/run/driver/kept_moments.hpp"
#include "engine/scene/scene.hpp"
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

}  // namespace grainreel
