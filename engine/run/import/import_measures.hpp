// What the observers of a run say of frames that another program wrote: all those that need places,
// velocities or contacts alone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/frame.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class ImportMeasures {
  public:
    ImportMeasures(const Scene& scene, const Clock& clock, const FrameSupply& supply);
    ~ImportMeasures();

    const std::vector<std::string>& names() const;
    // One row of measures.csv.
    Measures row(const Frame& frame, const std::vector<Touch>& touches);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
