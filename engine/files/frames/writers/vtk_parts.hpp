// What the writers of VTK's formats share: a frame becomes grains as points, walls as triangles and contacts
// as lines (vtk_file.hpp). Arrays have the names that other programs read: id, type (from 1, as in LAMMPS),
// omega.
#pragma once

#include <optional>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/frames/writers/vtk_file.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

class VtkWriter : public StateWriter {
  public:
    void begin(const StoredWorld& world, const StateSupply& supply) override;
    bool takes_all() const override { return true; }
    void contacts(const std::vector<SavedContact>& contacts) override;
    void cell(const std::optional<WorldCell>& now) override { world_.cell = now; }
    void frame(const State& frame, const std::vector<Link>& touches) final;

  protected:
    // A frame's parts; walls and contacts where the run has them.
    struct Parts {
        VtkPolyData grains;
        std::optional<VtkPolyData> walls, contacts;
    };
    virtual void write(const State& frame, Parts parts) = 0;

    bool has_walls() const { return !surfaces_.empty(); }
    // Frames without times are numbered instead.
    double time_of(const State& frame) const {
        return world_.time_known ? frame.time : static_cast<double>(frames_);
    }

    StoredWorld world_;
    StateSupply supply_;
    std::int64_t frames_ = 0;  // written before this one

  private:
    std::vector<WorldSurface> surfaces_;
    std::optional<std::vector<SavedContact>> contacts_;  // contacts of the next frame
    bool has_forces_ = false;                            // whether this frame or one before it has forces
};

}  // namespace grainreel
