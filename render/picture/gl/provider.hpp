// Which library makes the off-screen OpenGL context. The headers of films include this one and not those of
// OpenGL.
#pragma once

namespace grainreel::gl {

// automatic: OSMesa, which gives the same picture on every machine. If OSMesa is missing (Mesa dropped it in
// 25.1), EGL's software driver takes its place, with the same pictures. If that is missing too, EGL draws
// with what it has, and a note says so.
enum class Provider { automatic, osmesa, egl };

}  // namespace grainreel::gl
