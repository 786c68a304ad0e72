// Pressure and wear on the meshes of a run, triangle by triangle, out of its fields.nc.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class WearReader {
  public:
    // Throws UserError where the file cannot be read, is damaged, or is of other meshes; and where it has no
    // wear: then it says which instrument the scene lacks.
    WearReader(const std::filesystem::path& path, const Scene& scene);
    ~WearReader();

    // At a time (s) since the drive started, of each mesh of the scene: as the last record has it that has
    // ended by then. Before the first one the pressure is not known, and nothing is worn.
    std::shared_ptr<const std::vector<MeshWear>> until(double time) const;
    std::size_t records() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
