#include "render/gl/context.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel::gl {

void missing_function(const char* name) {
    throw RunError(fmt::format("the OpenGL library lacks {}; install one that offers OpenGL 3.3", name));
}

std::string Context::description() const {
    const auto text = [this](GLenum name) {
        const auto* string = reinterpret_cast<const char*>(functions_.GetString(name));
        return std::string(string ? string : "?");
    };
    return fmt::format("{}, {}, OpenGL {}", text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION));
}

void Context::check_version() const {
    GLint major = 0, minor = 0;
    functions_.GetIntegerv(GL_MAJOR_VERSION, &major);
    functions_.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33)
        throw RunError(fmt::format("OpenGL {}.{} is too old to draw with; 3.3 is needed", major, minor));
}

}  // namespace grainreel::gl
