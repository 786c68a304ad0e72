// OpenGL contexts through libOSMesa, and OpenGL objects. Contexts through libEGL are in egl_context.cpp.
#include "render/picture/gl/opengl.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <array>
#include <cstdlib>
#include <string>

#include "engine/base/error.hpp"
#include "render/picture/gl/addresses.hpp"

namespace grainreel::gl {
namespace {

thread_local Context* current = nullptr;

}  // namespace

void missing_function(const char* name) {
    throw RunError("the OpenGL library lacks {}; install one that offers OpenGL 3.3", name);
}

// Mesa's libraries share the thread's current context without telling each other. So one context is released
// before another is bound.
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
        throw RunError("OpenGL {}.{} is too old to draw with; 3.3 is needed", major, minor);
}

void set_raster_threads(int raster_threads) {
    GRAINREEL_CHECK(raster_threads >= 1);
    // Mesa takes 0 as "rasterise on the calling thread itself", which is what one thread means here.
    const std::string threads = std::to_string(raster_threads == 1 ? 0 : raster_threads);
    setenv("LP_NUM_THREADS", threads.c_str(), 1);
}

void choose_software_driver() {
    const char* asked = std::getenv("GALLIUM_DRIVER");
    const std::string driver = asked ? asked : "";
    if (driver != "llvmpipe" && driver != "softpipe") setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    unsetenv("MESA_GLSL_VERSION_OVERRIDE");
}

namespace {

// Mesa maps its cache of shaders into memory. If the disk of the cache is full, the first write there ends
// the process (SIGBUS). Our few shaders are compiled in 30 ms, so they are not kept, unless the user says
// otherwise.
void keep_no_shaders() {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
    setenv("MESA_GLSL_CACHE_DISABLE", "true", 0);  // its name before Mesa 21
}

}  // namespace

std::unique_ptr<Context> make_context(Provider provider, int raster_threads) {
    need_addresses(kAddressesOfContext);
    keep_no_shaders();
    if (provider == Provider::egl) return make_egl_context(raster_threads);
    if (provider == Provider::osmesa) return make_osmesa_context(raster_threads);
    std::string missing;
    try {
        return make_osmesa_context(raster_threads);
    } catch (const RunError& error) {
        missing = error.what();
    }
    try {  // the same driver through EGL, which gives the same pictures
        return make_egl_context(raster_threads, {EglPlatform::software});
    } catch (const RunError&) {
    }
    try {
        std::unique_ptr<Context> context = make_egl_context(raster_threads);
        context->set_note("drawn through EGL: " + missing);
        return context;
    } catch (const RunError& error) {
        throw RunError("no off-screen OpenGL: {}; and {}", missing, error.what());
    }
}

}  // namespace grainreel::gl

namespace grainreel::gl {
namespace {

// The few declarations of GL/osmesa.h that are used. That header itself would include the compatibility
// header GL/gl.h, which does not go together with the core header.
using OSMesaHandle = struct osmesa_context*;
using CreateContextAttribs = OSMesaHandle (*)(const int* attributes, OSMesaHandle share);
using MakeCurrent = unsigned char (*)(OSMesaHandle, void* buffer, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void (*)(OSMesaHandle);
using GetProcAddress = void (*(*)(const char* name))();
constexpr int osmesa_format = 0x22, osmesa_rgba = GL_RGBA, osmesa_profile = 0x33, osmesa_core = 0x34;
constexpr int osmesa_major = 0x36, osmesa_minor = 0x37;

struct Library {
    CreateContextAttribs create = nullptr;
    MakeCurrent make_current = nullptr;
    DestroyContext destroy = nullptr;
    GetProcAddress address = nullptr;
};

template <class Function>
void find(void* handle, const char* name, Function& into) {
    into = reinterpret_cast<Function>(dlsym(handle, name));
    if (!into) throw RunError(std::string("libOSMesa lacks ") + name + "; install Debian's libosmesa6");
}

// The library is opened once and never closed, because LLVM inside it does not survive being unloaded.
Library open_library() {
    void* handle = nullptr;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6"})
        if ((handle = dlopen(name, RTLD_NOW | RTLD_LOCAL))) break;
    if (!handle) throw RunError("libOSMesa.so.8 cannot be opened; install Debian's libosmesa6");
    Library library;
    find(handle, "OSMesaCreateContextAttribs", library.create);
    find(handle, "OSMesaMakeCurrent", library.make_current);
    find(handle, "OSMesaDestroyContext", library.destroy);
    find(handle, "OSMesaGetProcAddress", library.address);
    return library;
}

class OSMesaContext final : public Context {
  public:
    OSMesaContext() : Context("OSMesa") {
        static const Library opened = open_library();
        library_ = &opened;
        const std::array<int, 9> attributes = {
            osmesa_format, osmesa_rgba, osmesa_profile, osmesa_core, osmesa_major, 3, osmesa_minor, 3, 0};
        handle_ = library_->create(attributes.data(), nullptr);
        if (!handle_) throw RunError("OSMesa offers no OpenGL 3.3 core context; Mesa 13 or later is needed");
        try {
            make_current();
            functions_.fill(library_->address);
            check_version();
        } catch (...) {
            forget();
            library_->destroy(handle_);
            throw;
        }
    }

    ~OSMesaContext() override {
        forget();
        library_->destroy(handle_);
    }

  private:
    void bind() override {
        constexpr GLsizei side = 4;
        if (!library_->make_current(handle_, dummy_.data(), GL_UNSIGNED_BYTE, side, side))
            throw RunError("OSMesa refuses to make its context current");
    }
    void release() override { library_->make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

    const Library* library_ = nullptr;
    OSMesaHandle handle_ = nullptr;
    // The default framebuffer. It is copied at every glFinish and so kept tiny; pictures go to framebuffer
    // objects.
    std::array<unsigned char, 4 * 4 * 4> dummy_{};
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(int raster_threads) {
    set_raster_threads(raster_threads);
    choose_software_driver();
    return std::make_unique<OSMesaContext>();
}

}  // namespace grainreel::gl

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
    throw RunError("the {} shader of '{}' does not compile: {}",
                   kind == GL_VERTEX_SHADER ? "vertex" : "fragment", program, log);
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
    throw RunError("the shaders of '{}' do not link: {}", name, log);
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
    throw RunError("OpenGL refuses a picture of {}x{}; ask for a smaller one", width, height);
}

void Framebuffer::bind() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, id_);
    gl_.Viewport(0, 0, width_, height_);
}

}  // namespace grainreel::gl
