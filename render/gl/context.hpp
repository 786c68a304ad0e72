// An off-screen OpenGL core context. How it is made is the maker's business; drawing sees the function table.
#pragma once

#include <memory>
#include <string>

#include "render/gl/functions.hpp"

namespace grainreel::gl {

class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // To be called on the one thread that draws, whenever another context may have been used in between.
    virtual void make_current() = 0;

    const Functions& gl() const { return functions_; }
    std::string description() const;  // vendor, renderer, version

  protected:
    Context() = default;
    void check_version() const;  // throws RunError below OpenGL 3.3
    Functions functions_;
};

// Mesa's software rasteriser through libOSMesa, opened at run time. raster_threads >= 1. Mesa reads the
// number of its threads once a process, at the first context: later values are without effect. Throws
// RunError.
std::unique_ptr<Context> make_osmesa_context(int raster_threads);

}  // namespace grainreel::gl
