// Questions about a snapshot. Each answers with tables; numbers are SI. All throw UserError for what cannot
// be asked. The message does not name the option; the caller adds it.
#pragma once

#include <cstddef>
#include <string>

#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

// The moment, the species (count, mean height, height in flight, speeds), extremes, and what is odd: grains
// outside the container, and values that are not numbers.
Answer overview_of(const Snapshot& snapshot);

// All columns of one grain, and its contacts where they are known. At a moment that was brought back, also
// how they push, their sum against its weight and its acceleration, and its neighbours.
Answer grain_answer(const Snapshot& snapshot, std::int64_t id);

// A wall at a moment that was brought back. It is named as in contacts, "left slant" or "left_slant". The
// answer has its sums of force and moment, the force by height, and at most `most` of the grains that touch
// it.
Answer wall_answer(const Snapshot& snapshot, const std::string& name, std::size_t most);

// The contacts of a moment that was brought back: how many there are, how far they overlap, what the plan
// allows, and the `most` largest overlaps.
Answer largest_overlap_answer(const Snapshot& snapshot, std::size_t most);

// Says in a sentence whether the overlaps of a moment that was brought back keep to what run.overlap allows.
std::string overlap_verdict(const Snapshot& snapshot);

// The grains for which `condition` holds: how many of each species, statistics of their columns, and a list
// of at most `most` of them.
Answer where_answer(const Snapshot& snapshot, const std::string& condition, std::size_t most);

// The grains that a plane such as "y=0" or "z = 2 cm" cuts: their circles in it, by species and in a list
// of at most `most`.
Answer slice_answer(const Snapshot& snapshot, const std::string& plane, std::size_t most);

// A profile along a column ("height", "x", "y", "z", or "r" about the container's axis), in bins as wide as
// the mean diameter: grains and solid volume by species, mean speed and mean upward velocity; along height
// and z in a container also the solid fraction of each bin.
Answer profile_answer(const Snapshot& snapshot, const std::string& along);

// Counts a column's values, by species, in `bins` equal bins from the smallest to the largest.
Answer histogram_answer(const Snapshot& snapshot, const std::string& column, std::size_t bins);

// Radial distribution g(r) of centres up to four mean diameters: the number of partners at r, divided by the
// number in a uniform bed of as many grains in the box about all grains. A centre counts at r only if it is
// at least that far from the surface of the box, so that all its partners lie inside (border correction:
// Ripley, Statistical Inference for Spatial Processes, 1988).
Answer pair_distribution_answer(const Snapshot& snapshot);

// The grains that moved most between two moments of a run, in the container's frame: at most `most` of them,
// and statistics by species.
Answer compare_answer(const Snapshot& before, const Snapshot& after, std::size_t most);

}  // namespace grainreel
