#include "render/picture/gl/context.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "engine/base/error.hpp"

namespace grainreel::gl {
namespace {

thread_local Context* current = nullptr;

}  // namespace

void missing_function(const char* name) {
    throw RunError(fmt::format("the OpenGL library lacks {}; install one that offers OpenGL 3.3", name));
}

// Mesa's libraries share what is current on a thread without telling each other, so one lets go before
// another takes hold.
void Context::make_current() {
    if (current && current != this) current->release();
    current = nullptr;
    bind();
    current = this;
}

void Context::forget() {
    if (current != this) return;
    release();
    current = nullptr;
}

std::string Context::description() const {
    const auto text = [this](GLenum name) {
        const auto* string = reinterpret_cast<const char*>(functions_.GetString(name));
        return std::string(string ? string : "?");
    };
    return fmt::format("{}: {}, {}, OpenGL {}", maker_, text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION));
}

void Context::check_version() const {
    GLint major = 0, minor = 0;
    functions_.GetIntegerv(GL_MAJOR_VERSION, &major);
    functions_.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33)
        throw RunError(fmt::format("OpenGL {}.{} is too old to draw with; 3.3 is needed", major, minor));
}

void set_raster_threads(int raster_threads) {
    GRAINREEL_CHECK(raster_threads >= 1);
    // With 0 Mesa rasterises on the calling thread itself, which is what one thread means here.
    const std::string threads = std::to_string(raster_threads == 1 ? 0 : raster_threads);
    setenv("LP_NUM_THREADS", threads.c_str(), 1);
}

std::unique_ptr<Context> make_context(Provider provider, int raster_threads) {
    if (provider == Provider::egl) return make_egl_context(raster_threads);
    if (provider == Provider::osmesa) return make_osmesa_context(raster_threads);
    std::string missing;
    try {
        return make_osmesa_context(raster_threads);
    } catch (const RunError& error) {
        missing = error.what();
    }
    try {
        std::unique_ptr<Context> context = make_egl_context(raster_threads);
        context->set_note("drawn through EGL: " + missing);
        return context;
    } catch (const RunError& error) {
        throw RunError(fmt::format("no off-screen OpenGL: {}; and {}", missing, error.what()));
    }
}

}  // namespace grainreel::gl
