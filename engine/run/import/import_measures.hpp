// What the observers of a run say of frames that another program wrote: all those that need places,
// velocities or contacts alone.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
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

// Stress and wear that another program wrote on the triangles of its walls, as fields.nc of a run has them,
// so that films colour walls by them. LIGGGHTS: dump mesh/vtk with `stress` and `wear`.

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
