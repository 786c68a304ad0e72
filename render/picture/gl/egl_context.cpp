// OpenGL contexts through libEGL, which is opened at run time (opengl.hpp). This is a file of its own because
// of the macros that EGL's headers need.
#include <dlfcn.h>

#define EGL_NO_PLATFORM_SPECIFIC_TYPES  // no X11
#define EGL_EGL_PROTOTYPES 0            // all functions come from dlsym and eglGetProcAddress
#define EGL_EGLEXT_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/system/own_files.hpp"
#include "render/picture/gl/opengl.hpp"

namespace grainreel::gl {
namespace {

// The libraries of an unpacked archive are older than what newer systems' drivers ask for.
std::string remedy() {
    if (!own_files().empty())
        return "this system's EGL may not fit the libraries of the archive; leave out --gl egl";
    return "install Debian's libegl1 and libegl-mesa0, or the graphics driver's own EGL";
}

struct Library {
    PFNEGLGETPROCADDRESSPROC address = nullptr;
    PFNEGLQUERYSTRINGPROC query_string = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bind_api = nullptr;
    PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
    PFNEGLCREATECONTEXTPROC create_context = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
    PFNEGLCREATEPBUFFERSURFACEPROC create_surface = nullptr;
    PFNEGLDESTROYSURFACEPROC destroy_surface = nullptr;
    PFNEGLMAKECURRENTPROC make_current = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;             // null without the device platform
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;  // null without the device platform
    std::string extensions;                                        // extensions of the client
};

bool lists(const std::string& extensions, const std::string& name) {
    return (" " + extensions + " ").find(" " + name + " ") != std::string::npos;
}

template <class Function>
void find(void* handle, const char* name, Function& into) {
    into = reinterpret_cast<Function>(dlsym(handle, name));
    if (!into) throw RunError(std::string("libEGL lacks ") + name + "; " + remedy());
}

// The library is opened once and never closed, because drivers with LLVM inside do not survive being
// unloaded.
Library open_library() {
    void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw RunError(std::string("libEGL.so.1 cannot be opened; ") + remedy());
    Library egl;
    find(handle, "eglGetProcAddress", egl.address);
    find(handle, "eglQueryString", egl.query_string);
    find(handle, "eglInitialize", egl.initialize);
    find(handle, "eglBindAPI", egl.bind_api);
    find(handle, "eglChooseConfig", egl.choose_config);
    find(handle, "eglCreateContext", egl.create_context);
    find(handle, "eglDestroyContext", egl.destroy_context);
    find(handle, "eglCreatePbufferSurface", egl.create_surface);
    find(handle, "eglDestroySurface", egl.destroy_surface);
    find(handle, "eglMakeCurrent", egl.make_current);
    const char* extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    egl.extensions = extensions ? extensions : "";
    // Addresses are asked for only where the extension is listed, because eglGetProcAddress gives an address
    // for any name.
    if (lists(egl.extensions, "EGL_EXT_platform_base"))
        egl.platform_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.address("eglGetPlatformDisplayEXT"));
    if (!egl.platform_display)
        throw RunError(std::string("libEGL draws to windows only (no EGL_EXT_platform_base); ") + remedy());
    const bool devices =
        lists(egl.extensions, "EGL_EXT_device_base") || lists(egl.extensions, "EGL_EXT_device_enumeration");
    if (devices && lists(egl.extensions, "EGL_EXT_platform_device")) {
        egl.query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.address("eglQueryDevicesEXT"));
        egl.query_device_string =
            reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.address("eglQueryDeviceStringEXT"));
    }
    return egl;
}

const Library& library() {
    static const Library opened = open_library();
    return opened;
}

bool draws_in_software(const Library& egl, EGLDeviceEXT device) {
    const char* extensions = egl.query_device_string(device, EGL_EXTENSIONS);
    return extensions && lists(extensions, "EGL_MESA_device_software");
}

std::vector<EGLDisplay> displays_of(EglPlatform platform) {
    const Library& egl = library();
    std::vector<EGLDisplay> displays;
    if (platform == EglPlatform::surfaceless && lists(egl.extensions, "EGL_MESA_platform_surfaceless"))
        displays.push_back(egl.platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    if (platform != EglPlatform::surfaceless && egl.query_devices) {
        std::array<EGLDeviceEXT, 64> devices{};
        EGLint count = 0;
        if (egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count))
            for (const EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count)))
                if (platform == EglPlatform::device || draws_in_software(egl, device))
                    displays.push_back(egl.platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    return displays;
}

class EglContext final : public Context {
  public:
    // Throws RunError when the display offers no OpenGL 3.3.
    explicit EglContext(EGLDisplay display) : Context("EGL"), egl_(library()), display_(display) {
        // Contexts on one display share its initialization, so the display is never terminated. Initializing
        // it again does no harm.
        if (display == EGL_NO_DISPLAY || !egl_.initialize(display, nullptr, nullptr))
            throw RunError("a display does not initialize");
        try {
            create();
            make_current();
            functions_.fill(egl_.address);
            check_version();
        } catch (...) {
            destroy();
            throw;
        }
    }

    ~EglContext() override { destroy(); }

  private:
    void create() {
        egl_.bind_api(EGL_OPENGL_API);
        constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                                  EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!egl_.choose_config(display_, wanted.data(), &config, 1, &count) || count < 1)
            throw RunError("a display has no off-screen OpenGL");
        constexpr std::array<EGLint, 7> version = {EGL_CONTEXT_MAJOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};
        context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, version.data());
        if (context_ == EGL_NO_CONTEXT) throw RunError("a display offers no OpenGL 3.3 core context");
        // Nothing is drawn to the default framebuffer, so it is kept tiny.
        constexpr std::array<EGLint, 5> size = {EGL_WIDTH, 4, EGL_HEIGHT, 4, EGL_NONE};
        surface_ = egl_.create_surface(display_, config, size.data());
        if (surface_ == EGL_NO_SURFACE) throw RunError("a display offers no off-screen surface");
    }

    void destroy() {
        forget();
        if (surface_ != EGL_NO_SURFACE) egl_.destroy_surface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
    }

    void bind() override {
        egl_.bind_api(EGL_OPENGL_API);
        if (!egl_.make_current(display_, surface_, surface_, context_))
            throw RunError("EGL refuses to make its context current");
    }
    void release() override { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

    const Library& egl_;
    const EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<Context> make_egl_context(int raster_threads, const std::vector<EglPlatform>& order) {
    set_raster_threads(raster_threads);
    if (order == std::vector<EglPlatform>{EglPlatform::software}) choose_software_driver();
    std::string why = "there is neither a device nor a surfaceless platform";
    for (const EglPlatform platform : order)
        for (const EGLDisplay display : displays_of(platform)) {
            try {
                return std::make_unique<EglContext>(display);
            } catch (const RunError& error) {
                why = error.what();
            }
        }
    throw RunError("EGL gives no off-screen OpenGL context (" + why + "); " + remedy());
}

}  // namespace grainreel::gl
