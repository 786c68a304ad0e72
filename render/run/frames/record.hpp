// What lies on disk and can be asked questions: a run, or one state of it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "render/run/frames/frame_source.hpp"

namespace grainreel {

class Record : public FrameSource, public FrameArchive {
  public:
    using FrameArchive::moments;
    using FrameSource::moments;

    virtual const Clock& clock() const = 0;
    // From which its other moments, and its forces, are brought back. By rising step.
    virtual std::vector<KeptCheckpoint> checkpoints() const = 0;
    // Names the checkpoints that are passed over, and why: they are of another run, or damaged.
    virtual std::vector<std::string> checkpoint_news() const { return {}; }
    // Damage of the files beside the checkpoints, which makes answers poorer than the run was.
    virtual std::vector<std::string> faults() const { return {}; }
    // Whether all contacts of a moment are among what was kept of it.
    virtual bool has_contacts_of(std::size_t index) const = 0;
    // The run's first moment, from which ways are counted; without grains where it is not known.
    virtual Frame first() const = 0;
    // What was measured about then; nothing where it does not lie beside the moments.
    virtual std::optional<MeasuredRow> measured_near(std::size_t index) const = 0;
};

}  // namespace grainreel
