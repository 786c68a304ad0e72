// An off-screen OpenGL core context. How it is made is the maker's business; drawing sees the function table.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/gl/functions.hpp"
#include "render/picture/gl/provider.hpp"

namespace grainreel::gl {

class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // To be called on the one thread that draws, whenever another context may have been used in between:
    // several contexts may live on one thread, also of different providers.
    void make_current();

    const Functions& gl() const { return functions_; }
    std::string description() const;  // "EGL: ", then vendor, renderer and version
    // Why this is not what one would have expected; mostly empty.
    const std::string& note() const { return note_; }
    void set_note(std::string note) { note_ = std::move(note); }

  protected:
    explicit Context(std::string maker) : maker_(std::move(maker)) {}
    virtual void bind() = 0;     // throws RunError
    virtual void release() = 0;  // nothing is current afterwards
    void forget();               // for destructors: releases it if it is current
    void check_version() const;  // throws RunError below OpenGL 3.3
    Functions functions_;

  private:
    const std::string maker_;
    std::string note_;
};

// raster_threads >= 1: of Mesa's software rasteriser, which reads the number once a process, at the first
// context: later values are without effect. All throw RunError when the library or the context is not to be
// had.

// Mesa's software rasteriser through libOSMesa, opened at run time.
std::unique_ptr<Context> make_osmesa_context(int raster_threads);

// Through libEGL, opened at run time: a context on a device (EGL_EXT_platform_device: the first one that
// gives it, a GPU where there is one), or without any (EGL_MESA_platform_surfaceless), in the order asked
// for.
enum class EglPlatform { device, surfaceless };
std::unique_ptr<Context> make_egl_context(int raster_threads,
                                          const std::vector<EglPlatform>& order = {EglPlatform::device,
                                                                                   EglPlatform::surfaceless});

std::unique_ptr<Context> make_context(Provider provider, int raster_threads);

// For Mesa, before its first context is made.
void set_raster_threads(int raster_threads);

}  // namespace grainreel::gl
