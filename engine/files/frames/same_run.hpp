// Checks whether the files in a run's folder are of one run, by comparing what they have in common. All
// functions throw UserError with a line that names the two files that disagree.
#pragma once

#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Compares the number of species. trajectory, and measures below: names of the files, for messages.
void check_species(const Scene& scene, const StoredWorld& world, const std::string& trajectory);
// Compares the shapes of meshes. in_file: the world according to the trajectory.
void check_meshes(const Scene& scene, const StoredWorld& in_file, const std::string& trajectory);
// Compares the number of grains, and in one frame the number and sizes of the grains of each species.
void check_grains(const Scene& scene, const StoredWorld& world, const State& frame,
                  const std::string& trajectory);
// Compares step, periods and phase of a moment, and the places of container and meshes at that time. frame:
// "x.nc: frame 3".
void check_drive(const Scene& scene, const Clock& clock, const State& moment, const std::string& frame);
// Compares times and periods of the rows, and the grains' centre of mass at a moment that both files have.
void check_measures(const Scene& scene, const Clock& clock, const MeasureTable& table,
                    const StateArchive& trajectory, const std::string& measures);
// Compares the grains' centre of mass at a moment if the table has a row for it. If two files disagree only
// at one moment, they are of one run and one of them was altered.
void check_measures_at(const Scene& scene, const MeasureTable& table, const State& frame,
                       const std::string& measures);
// Checks that grains in contact touch in the frame.
void check_contacts(const Scene& scene, const std::vector<Link>& touches, const State& frame,
                    const std::string& contacts);

}  // namespace grainreel
