// Whether the files in a run's folder are of one run: what each says of the others is compared. All throw
// UserError with a line that names the two that disagree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// trajectory, measures: the files' names, for messages.
void check_species(const Scene& scene, const World& world, const std::string& trajectory);
// The shapes of the scene's meshes. said: what the trajectory says of its world.
void check_meshes(const Scene& scene, const World& said, const std::string& trajectory);
// How many grains the trajectory has, and in one of its frames how many of each species and of what size.
void check_grains(const Scene& scene, const World& world, const Frame& frame, const std::string& trajectory);
// Step, periods and phase of a moment, and where the drive has the container then, and their motions the
// meshes. frame: "x.nc: frame 3".
void check_drive(const Scene& scene, const Clock& clock, const Frame& moment, const std::string& frame);
// Times and periods of the rows, and the grains' centre of mass at a moment that both files have.
void check_measures(const Scene& scene, const Clock& clock, const MeasureTable& table,
                    const FrameArchive& trajectory, const std::string& measures);
// The grains' centre of mass at a moment, where the table has a row of it. Two files that disagree at one
// moment alone are of one run, and one of them was altered.
void check_measured(const Scene& scene, const MeasureTable& table, const Frame& frame,
                    const std::string& measures);
// Grains that push each other touch in the frame too.
void check_contacts(const Scene& scene, const std::vector<Touch>& touches, const Frame& frame,
                    const std::string& contacts);

// Where a column of measures.csv is; none when the file lacks it.
std::optional<std::size_t> column_of(const MeasureTable& table, const std::string& name);

}  // namespace grainreel
