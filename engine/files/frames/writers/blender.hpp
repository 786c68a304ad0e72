// The script that builds a bed in Blender.
#pragma once

namespace grainreel {

const char* blender_script();

}  // namespace grainreel
