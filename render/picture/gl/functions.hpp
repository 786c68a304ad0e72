// The OpenGL functions that drawing uses, and no others, as a table that the context's maker fills: nothing
// links against a GL library, so one binary serves every way of getting a context.
#pragma once

#include <GL/glcorearb.h>

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
