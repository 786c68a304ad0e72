// The keys of one kind of contact, as [contact], [contact.wall] and [[contact.pair]] have them.
#pragma once

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

const keys::KeyTable<PairContact>& contact_table();

// The tangential law that suits a normal law.
TangentialLaw suiting(NormalLaw law);

}  // namespace grainreel
