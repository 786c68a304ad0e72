// The key `show` of [film]: which words and signs stand beside the grains.
#pragma once

#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

keys::BoundKey<Film> word_kinds_key();

}  // namespace grainreel
