// OpenGL objects that delete themselves. Each may be used only on the thread of its context.
#pragma once

#include <string>

#include "render/picture/gl/context.hpp"

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
