// Which library makes the off-screen OpenGL context. The headers of films include this one and not those of
// OpenGL.
#pragma once

namespace grainreel::gl {

// automatic: OSMesa, which gives the same picture on every machine. If OSMesa is missing (Mesa dropped it in
// 25.1), EGL takes its place, and a note says so.
enum class Provider { automatic, osmesa, egl };

}  // namespace grainreel::gl
