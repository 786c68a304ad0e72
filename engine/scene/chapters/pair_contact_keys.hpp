// The keys of one kind of contact, as [contact], [contact.wall] and [[contact.pair]] have them.
#pragma once

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

const keys::KeyTable<PairContact>& contact_table();

// Each normal law has a tangential one that suits it.
TangentialLaw suiting(NormalLaw law);

}  // namespace grainreel
