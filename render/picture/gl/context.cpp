#include "render/picture/gl/context.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <array>
#include <cstdlib>
#include <string>

#include "engine/base/error.hpp"

namespace grainreel::gl {
namespace {

thread_local Context* current = nullptr;

}  // namespace

void missing_function(const char* name) {
    throw RunError(fmt::format("the OpenGL library lacks {}; install one that offers OpenGL 3.3", name));
}

// Mesa's libraries share what is current on a thread without telling each other. So one context lets go
// before another takes hold.
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
    return std::make_unique<OSMesaContext>();
}

}  // namespace grainreel::gl
