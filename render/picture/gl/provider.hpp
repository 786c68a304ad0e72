// Who makes the off-screen OpenGL context.
#pragma once

namespace grainreel::gl {

// automatic: OSMesa, which gives the same picture on every machine; where it is not to be had (it left Mesa
// with 25.1), EGL, and a note that says so.
enum class Provider { automatic, osmesa, egl };

}  // namespace grainreel::gl
