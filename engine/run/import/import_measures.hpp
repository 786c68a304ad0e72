// Measures of a run that another program wrote: ImportMeasures makes measures.csv from the frames, ImportWear
// makes fields.nc from stress and wear in the files of walls.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// The grains of a frame, with their own masses or with the density of their species.
Grains grains_of(const State& frame, const Scene& scene);

// Runs those observers that need only places, velocities or contacts.
class ImportMeasures {
  public:
    // weighed: whether masses are known, so that kinetic energies are measured where velocities are there.
    ImportMeasures(const Scene& scene, const Clock& clock, const StateSupply& supply, bool weighed);
    ~ImportMeasures();

    const std::vector<std::string>& names() const;
    // The row of measures.csv for a frame.
    Measures row(const State& frame, const std::vector<Link>& touches);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Writes stress and wear of walls, which another program gives for each triangle, as the fields.nc of a run,
// so that films can colour walls by them. LIGGGHTS writes them by dump mesh/vtk with `stress` and `wear`.
class ImportWear {
  public:
    // Whether some wall has stress or wear at its first moment.
    static bool known(const ForeignArchive& archive);

    // `scene` is the scene of the imported run; its last meshes are the walls of the archive. Throws RunError
    // if the file cannot be made.
    ImportWear(const std::filesystem::path& file, const Scene& scene, const ForeignArchive& archive,
               const std::string& program_version);
    ~ImportWear();

    // Writes the values at a moment of the archive. They count from the moment before until this one.
    void write(std::size_t moment);

    // What the user should know about these values, a line for each finding.
    std::vector<std::string> news() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
