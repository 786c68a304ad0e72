// Key moments of a run: those of which it keeps all contacts with their forces (key_moments.nc,
// key_contacts.nc), for its page. The start, the end and the two periods before it, times that somebody
// names, and some in between.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Their steps, from `first` to the plan's last. named: s of simulated time, such as those at which captions
// of a film begin. The more grains, the fewer, so that both files together take 40 MB or so; none where a
// single moment takes more.
std::set<std::int64_t> key_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                 const std::vector<double>& named);

}  // namespace grainreel
