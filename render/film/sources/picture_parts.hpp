// PictureParts is the one place that adds to a shot what its picture shows besides the moment itself:
// displacements since an earlier period, the moments of an exposure, means over periods, contacts, measures
// for plots and live words, what has flowed out, and the way from one locked moment to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/measure/measures.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/period_choice.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What is known about a picture's moment beside its grains, as far as the film shows it.
struct Beside {
    std::vector<Link> touches{};
    std::shared_ptr<const MeasureTable> measures{};  // null for none
    std::size_t measure_rows = 0;                    // number of rows up to the moment
    // What the grains do to the meshes, one entry for each mesh; null when that is not known.
    std::shared_ptr<const std::vector<MeshWear>> worn{};
    std::optional<FlowedOut> flowed_out{};  // what has left the run up to the moment
};
// Grains and bodies at a step; null when they cannot be had.
using OtherMoments = std::function<StatePtr(std::int64_t step)>;

class PictureParts {
  public:
    // Only the film of the scene is used. first: the first step that can be had.
    PictureParts(const FilmedScene& scene, const Clock& clock, std::int64_t first);

    // The other moments that the picture at `step` needs, in no particular order; some may come twice. rule:
    // the segment by which the picture is taken. periods: number of periods after which the bed repeats
    // itself.
    std::vector<WantedState> moments(std::int64_t step, const FilmSegment& rule, int periods) const;

    // Adds what is beside the moment, and what others() can give. A grain that is missing at an earlier
    // moment gets no displacement or no mean.
    void add(Shot& shot, const FilmSegment& rule, int periods, Beside beside,
             const OtherMoments& others) const;

  private:
    // Steps of the moments that displacements, the exposure and the mean need; empty when the picture has no
    // such part.
    std::vector<std::int64_t> earlier(std::int64_t step, int periods) const;
    std::vector<std::int64_t> exposed(std::int64_t step, const FilmSegment& rule, int periods) const;
    std::vector<std::int64_t> averaged(std::int64_t step, const FilmSegment& rule, int periods) const;
    void add_mean(Shot& shot, const FilmSegment& rule, int periods, const OtherMoments& others) const;

    FilmShows shows_;
    Clock clock_;
    std::int64_t first_;
    double depth_;  // m, period of a periodic container along x; 0 for none
};

}  // namespace grainreel
