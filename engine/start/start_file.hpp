// A start from an earlier run's file, or from grains listed in the scene: reads the grains and checks
// whether they are those that the scene describes. All functions throw UserError at the place of
// `start.file` or of the list.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// Numbers from 0 without gaps, in the order of the ids. Ids have gaps where grains have left the run.
std::vector<std::int32_t> numbers_without_gaps(const std::vector<std::int32_t>& ids);

// The grains of a final.csv, in the order of the file, numbered without gaps.
Grains grains_from_table(const Scene& scene);

// The grains of [[grain]], numbered as listed.
Grains listed_grains(const Scene& scene);

// Checks that each grain is possible: of a species of the scene, with finite values, not so far out that a
// double is too coarse, with a unit quaternion if it is turned, and with a number of its own.
void check_grains_possible(const Scene& scene, const Grains& grains);

// Checks that grains are numbered from 0 without gaps, so that none have left.
void check_grains_numbered(const Scene& scene, const Grains& grains);

// Throws UserError where the grains have other sizes than the scene says.
void check_sizes_match(const Scene& scene, const Grains& grains);

// Throws UserError where the number or the sizes of a species' grains are not those of the scene.
void check_grains_match(const Scene& scene, const Grains& grains);

// Throws UserError where grains have other masses than their species.
void check_masses(const Scene& scene, const Grains& grains);

// Says why no grain can lie at this place (m) in the frame of a mesh: "lies inside the mesh \"drum\"". Empty
// where one can: a grain may lie in the vessel's room, around a vessel that is open, and outside any other
// closed mesh.
std::string why_no_grain_at(const Scene& scene, const MeshWall& mesh, const Vec3& place);

// Throws UserError where a grain is outside the container at rest, in a closed mesh, or so near to a mesh
// that it overlaps it by more than a third of its radius.
void check_grains_fit(const Scene& scene, const Surroundings& around, const Grains& grains);

// Throws UserError where a grain overlaps another, or a wall, by more than a third of a radius. `loop` has
// been restarted.
void check_grains_clear(const Scene& scene, const Surroundings& around, const Grains& grains,
                        const StepLoop& loop);

}  // namespace grainreel
