// Key moments of a run: those of which it keeps all contacts with their forces, for its page. The start, the
// end and the two periods before it, where captions begin, and some in between. Grains lie in key_moments.nc,
// in the format of trajectory.nc; contacts in key_contacts.nc, in that of contacts.nc, whose `frame` counts
// the frames of the former.
#pragma once

#include <cstdint>
#include <set>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

inline constexpr const char *kKeyMoments = "key_moments.nc", *kKeyContacts = "key_contacts.nc";

// Their steps, from `first` to the plan's last. The more grains, the fewer, so that both files together take
// 40 MB or so; none where a single moment takes more.
std::set<std::int64_t> key_steps(const FilmedScene& scene, const Plan& plan, std::int64_t first);

}  // namespace grainreel
