// OpenGL: an off-screen core context, the table of the functions that drawing uses, and objects that delete
// themselves. The maker of a context fills the table, and nothing links against a GL library, so that one
// binary serves every way of getting a context. A new function that drawing needs is added to
// GRAINREEL_GL_FUNCTIONS. Each object may be used only on the thread of its context.
#pragma once

#include <GL/glcorearb.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/gl/provider.hpp"

namespace grainreel::gl {

// F(type of the pointer, name without "gl")
#define GRAINREEL_GL_FUNCTIONS(F)                                \
    F(PFNGLACTIVETEXTUREPROC, ActiveTexture)                     \
    F(PFNGLATTACHSHADERPROC, AttachShader)                       \
    F(PFNGLBINDBUFFERPROC, BindBuffer)                           \
    F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
    F(PFNGLBINDTEXTUREPROC, BindTexture)                         \
    F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
    F(PFNGLBLENDFUNCPROC, BlendFunc)                             \
    F(PFNGLBUFFERDATAPROC, BufferData)                           \
    F(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
    F(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                     \
    F(PFNGLCOMPILESHADERPROC, CompileShader)                     \
    F(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
    F(PFNGLCREATESHADERPROC, CreateShader)                       \
    F(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
    F(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
    F(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
    F(PFNGLDELETESHADERPROC, DeleteShader)                       \
    F(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
    F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
    F(PFNGLDISABLEPROC, Disable)                                 \
    F(PFNGLDRAWARRAYSPROC, DrawArrays)                           \
    F(PFNGLENABLEPROC, Enable)                                   \
    F(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) \
    F(PFNGLFINISHPROC, Finish)                                   \
    F(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)       \
    F(PFNGLGENBUFFERSPROC, GenBuffers)                           \
    F(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
    F(PFNGLGENTEXTURESPROC, GenTextures)                         \
    F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
    F(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
    F(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
    F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
    F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)               \
    F(PFNGLGETSHADERIVPROC, GetShaderiv)                         \
    F(PFNGLGETSTRINGPROC, GetString)                             \
    F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
    F(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
    F(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
    F(PFNGLREADPIXELSPROC, ReadPixels)                           \
    F(PFNGLSCISSORPROC, Scissor)                                 \
    F(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
    F(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
    F(PFNGLTEXPARAMETERIPROC, TexParameteri)                     \
    F(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                     \
    F(PFNGLUNIFORM1FPROC, Uniform1f)                             \
    F(PFNGLUNIFORM1IPROC, Uniform1i)                             \
    F(PFNGLUNIFORM2FPROC, Uniform2f)                             \
    F(PFNGLUNIFORM3FPROC, Uniform3f)                             \
    F(PFNGLUNIFORM4FPROC, Uniform4f)                             \
    F(PFNGLUSEPROGRAMPROC, UseProgram)                           \
    F(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)         \
    F(PFNGLVIEWPORTPROC, Viewport)

struct Functions {
#define GRAINREEL_GL_MEMBER(type, name) type name = nullptr;
    GRAINREEL_GL_FUNCTIONS(GRAINREEL_GL_MEMBER)
#undef GRAINREEL_GL_MEMBER

    // load: from a name ("glClear") to an address. Throws RunError naming a function that is missing.
    template <class Load>
    void fill(Load load);
};

[[noreturn]] void missing_function(const char* name);

template <class Load>
void Functions::fill(Load load) {
#define GRAINREEL_GL_LOAD(type, name)                \
    name = reinterpret_cast<type>(load("gl" #name)); \
    if (!name) missing_function("gl" #name);
    GRAINREEL_GL_FUNCTIONS(GRAINREEL_GL_LOAD)
#undef GRAINREEL_GL_LOAD
}

}  // namespace grainreel::gl

namespace grainreel::gl {

class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // Must be called on the one thread that draws, whenever another context may have been used in between.
    // Several contexts may live on one thread, also of different providers.
    void make_current();

    const Functions& gl() const { return functions_; }
    std::string description() const;  // "EGL: ", then vendor, renderer and version
    // Why this is not the kind of context that one would expect; empty if it is.
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

// The functions below make contexts, and throw RunError when there is no library or no context.
// raster_threads >= 1: threads of Mesa's software rasteriser. Mesa reads this number once in a process, for
// the first context; later values have no effect.

// Mesa's software rasteriser through libOSMesa, opened at run time.
std::unique_ptr<Context> make_osmesa_context(int raster_threads);

// A context through libEGL, which is opened at run time. It is made on a device (EGL_EXT_platform_device; the
// first device that gives a context, a GPU if there is one), on the software driver among the devices
// (EGL_MESA_device_software), or without a device (EGL_MESA_platform_surfaceless). `order` says which is
// tried first.
enum class EglPlatform { device, software, surfaceless };
std::unique_ptr<Context> make_egl_context(int raster_threads,
                                          const std::vector<EglPlatform>& order = {EglPlatform::device,
                                                                                   EglPlatform::surfaceless});

std::unique_ptr<Context> make_context(Provider provider, int raster_threads);

// Tells Mesa the number of threads, before its first context is made.
void set_raster_threads(int raster_threads);

// Takes back what the environment says of Mesa's drivers, before a context that draws in software is made:
// OSMesa crashes where GALLIUM_DRIVER names a driver that it lacks (d3d12, which WSL uses), or where an
// override asks for an older OpenGL. softpipe stays, which needs no LLVM.
void choose_software_driver();

}  // namespace grainreel::gl

namespace grainreel::gl {

// A vertex and a fragment shader, compiled and linked. Throws RunError with the compiler's log.
class Program {
  public:
    Program(const Functions& gl, const char* name, const std::string& vertex, const std::string& fragment);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const { gl_.UseProgram(id_); }
    // Set a uniform of the program, which must be in use. As in OpenGL, uniforms that it does not use are
    // ignored.
    void set(const char* uniform, int value) const { gl_.Uniform1i(place(uniform), value); }
    void set(const char* uniform, float value) const { gl_.Uniform1f(place(uniform), value); }
    void set(const char* uniform, float x, float y) const { gl_.Uniform2f(place(uniform), x, y); }
    void set(const char* uniform, float x, float y, float z) const { gl_.Uniform3f(place(uniform), x, y, z); }
    void set(const char* uniform, float x, float y, float z, float w) const {
        gl_.Uniform4f(place(uniform), x, y, z, w);
    }

  private:
    GLint place(const char* uniform) const { return gl_.GetUniformLocation(id_, uniform); }
    const Functions& gl_;
    GLuint id_ = 0;
};

// Arguments of glTexImage2D.
struct TextureFormat {
    GLenum internal, format, type;
};

// A texture that is read texel by texel, without filtering. Its contents are undefined at first.
class Texture {
  public:
    Texture(const Functions& gl, int width, int height, const TextureFormat& format);
    ~Texture() { gl_.DeleteTextures(1, &id_); }
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;
    GLuint id() const { return id_; }

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

// A texture to draw into.
class Framebuffer {
  public:
    // width, height >= 1. Throws RunError when the driver refuses it.
    Framebuffer(const Functions& gl, int width, int height, const TextureFormat& format);
    ~Framebuffer() { gl_.DeleteFramebuffers(1, &id_); }
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;

    void bind() const;  // also sets the viewport
    int width() const { return width_; }
    int height() const { return height_; }

  private:
    const Functions& gl_;
    const int width_, height_;
    Texture texture_;
    GLuint id_ = 0;
};

// A vertex array. It has no vertices of its own: attributes come from Buffer objects that are bound to it.
class VertexArray {
  public:
    explicit VertexArray(const Functions& gl) : gl_(gl) { gl_.GenVertexArrays(1, &id_); }
    ~VertexArray() { gl_.DeleteVertexArrays(1, &id_); }
    VertexArray(const VertexArray&) = delete;
    VertexArray& operator=(const VertexArray&) = delete;
    void bind() const { gl_.BindVertexArray(id_); }

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

class Buffer {
  public:
    explicit Buffer(const Functions& gl) : gl_(gl) { gl_.GenBuffers(1, &id_); }
    ~Buffer() { gl_.DeleteBuffers(1, &id_); }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    void bind() const { gl_.BindBuffer(GL_ARRAY_BUFFER, id_); }
    void fill(const void* data, std::size_t bytes) const {
        bind();
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
    }
    GLuint id() const { return id_; }

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

}  // namespace grainreel::gl
