// A JSON Schema of a list of keys, by which editors complete and check scene files (taplo, Even Better TOML).
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"

namespace grainreel {

// The schema as JSON text, in draft 7 (json-schema.org/draft-07), which is the draft that taplo reads. It
// says types, units as patterns, ranges, defaults, meanings, which keys a table must have and which exclude
// each other. It takes every file that the reader takes. The reader refuses more, such as keys that have no
// meaning in this scene, or a unit that measures something else.
std::string json_schema(const std::vector<Key>& keys, const std::string& title);

}  // namespace grainreel
