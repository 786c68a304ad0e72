// Reads pressure and wear of each triangle of a run's meshes from its fields.nc.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class WearReader {
  public:
    // Throws UserError where the file cannot be read, is damaged or has other meshes. Where it has no wear,
    // the message says which instrument the scene needs.
    WearReader(const std::filesystem::path& path, const Scene& scene);
    ~WearReader();

    // Pressure and wear of each mesh at a time (s since the drive started), from the last record that has
    // ended by then. Before the first record the pressure is not known and nothing is worn.
    std::shared_ptr<const std::vector<MeshWear>> until(double time) const;
    std::size_t records() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
