// A start from an earlier run's file, or from grains listed in the scene: the grains, and whether they are
// those that the scene speaks of. All throw UserError with the place of `start.file`, or of the list.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// Numbers from 0 without gaps, in the order of the ids. The ids of a run that grains have left have gaps.
std::vector<std::int32_t> numbers_without_gaps(const std::vector<std::int32_t>& ids);

// The grains of a final.csv, in its order, numbered without gaps.
Grains grains_from_table(const Scene& scene);

// Those of [[grain]], numbered as listed.
Grains listed_grains(const Scene& scene);

// Each a grain that there can be: of a species of the scene, with finite values, not so far out that places
// there are coarse, turned by a unit quaternion if at all; and its number is no other's.
void check_grains_possible(const Scene& scene, const Grains& grains);

// Numbered from 0 without gaps, as grains of which none have left.
void check_grains_numbered(const Scene& scene, const Grains& grains);

// Throws UserError where the grains have other sizes than the scene says.
void check_sizes_match(const Scene& scene, const Grains& grains);

// Throws UserError where the grains of a species are not as many, or not as large, as the scene says.
void check_grains_match(const Scene& scene, const Grains& grains);

// With the masses that their species has.
void check_masses(const Scene& scene, const Grains& grains);

// All inside the container at rest, and none in a closed mesh or so near to a mesh that it overlaps it by
// more than a third of its radius (grains_fit.cpp).
void check_grains_fit(const Scene& scene, const Surroundings& around, const Grains& grains);

// None overlaps another, or a wall, by more than a third of a radius. `loop` has been restarted.
void check_grains_clear(const Scene& scene, const Surroundings& around, const Grains& grains,
                        const StepLoop& loop);

}  // namespace grainreel
