// Stress and wear that another program wrote on the triangles of its walls, as fields.nc of a run has them,
// so that films colour walls by them. LIGGGHTS: dump mesh/vtk with `stress` and `wear`.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class ImportWear {
  public:
    // Whether some wall has stress or wear at each of its moments.
    static bool known(const ForeignArchive& archive);

    // scene: of the import; the walls of the archive are its last meshes. Throws RunError where the file
    // cannot be made.
    ImportWear(const std::filesystem::path& file, const Scene& scene, const ForeignArchive& archive,
               const std::string& program_version);
    ~ImportWear();

    // The values that hold at a moment of the archive, and from the moment before until then.
    void write(std::size_t moment);

    // What the user is to know of them, a line each.
    std::vector<std::string> news() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
