#include <dlfcn.h>

#include <array>
#include <string>

#include "engine/base/error.hpp"
#include "render/picture/gl/context.hpp"

namespace grainreel::gl {
namespace {

// The few declarations of GL/osmesa.h that are used; that header would pull in the compatibility GL/gl.h,
// which does not go together with the core header.
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

// Opened once and never closed: LLVM inside it does not survive being unloaded.
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
    // The default framebuffer, copied at every glFinish and so kept tiny: pictures go to framebuffer objects.
    std::array<unsigned char, 4 * 4 * 4> dummy_{};
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(int raster_threads) {
    set_raster_threads(raster_threads);
    return std::make_unique<OSMesaContext>();
}

}  // namespace grainreel::gl
