#include "render/picture/gl/objects.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel::gl {
namespace {

constexpr std::size_t log_limit = 4096;

GLuint compile(const Functions& gl, const char* program, GLenum kind, const std::string& source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint done = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done) return shader;
    std::string log(log_limit, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteShader(shader);
    throw RunError(fmt::format("the {} shader of '{}' does not compile: {}",
                               kind == GL_VERTEX_SHADER ? "vertex" : "fragment", program, log));
}

}  // namespace

Program::Program(const Functions& gl, const char* name, const std::string& vertex,
                 const std::string& fragment)
    : gl_(gl) {
    const GLuint first = compile(gl_, name, GL_VERTEX_SHADER, vertex);
    GLuint second = 0;
    try {
        second = compile(gl_, name, GL_FRAGMENT_SHADER, fragment);
    } catch (...) {
        gl_.DeleteShader(first);
        throw;
    }
    id_ = gl_.CreateProgram();
    gl_.AttachShader(id_, first);
    gl_.AttachShader(id_, second);
    gl_.LinkProgram(id_);
    gl_.DeleteShader(first);
    gl_.DeleteShader(second);
    GLint done = 0;
    gl_.GetProgramiv(id_, GL_LINK_STATUS, &done);
    if (done) return;
    std::string log(log_limit, '\0');
    GLsizei length = 0;
    gl_.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl_.DeleteProgram(id_);
    throw RunError(fmt::format("the shaders of '{}' do not link: {}", name, log));
}

Program::~Program() {
    gl_.DeleteProgram(id_);
}

Texture::Texture(const Functions& gl, int width, int height, const TextureFormat& format) : gl_(gl) {
    gl_.GenTextures(1, &id_);
    gl_.BindTexture(GL_TEXTURE_2D, id_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal), width, height, 0, format.format,
                   format.type, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Framebuffer::Framebuffer(const Functions& gl, int width, int height, const TextureFormat& format)
    : gl_(gl), width_(width), height_(height), texture_(gl, width, height, format) {
    gl_.GenFramebuffers(1, &id_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, id_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    gl_.DeleteFramebuffers(1, &id_);
    throw RunError(fmt::format("OpenGL refuses a picture of {}x{}; ask for a smaller one", width, height));
}

void Framebuffer::bind() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, id_);
    gl_.Viewport(0, 0, width_, height_);
}

}  // namespace grainreel::gl
