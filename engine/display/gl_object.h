// OpenGL names with an owner: made in a current context, deleted in it, moved but never copied.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace stereonav {

template <typename Kind>
class GlObject {
public:
    GlObject() : mName(Kind::make()) {}
    ~GlObject() {
        if (mName != 0) Kind::remove(mName);
    }
    GlObject(GlObject&& other) noexcept : mName(std::exchange(other.mName, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(mName, other.mName);
        return *this;
    }
    GLuint name() const { return mName; }

private:
    GLuint mName;
};

// Functions that make and delete names of one kind; both need a current context.
struct GlTextureKind {
    static GLuint make() {
        GLuint name = 0;
        glGenTextures(1, &name);
        return name;
    }
    static void remove(GLuint name) { glDeleteTextures(1, &name); }
};
struct GlVertexArrayKind {
    static GLuint make() {
        GLuint name = 0;
        glGenVertexArrays(1, &name);
        return name;
    }
    static void remove(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct GlFramebufferKind {
    static GLuint make() {
        GLuint name = 0;
        glGenFramebuffers(1, &name);
        return name;
    }
    static void remove(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct GlProgramKind {
    static GLuint make() { return glCreateProgram(); }
    static void remove(GLuint name) { glDeleteProgram(name); }
};

using GlTexture = GlObject<GlTextureKind>;
using GlVertexArray = GlObject<GlVertexArrayKind>;
using GlFramebuffer = GlObject<GlFramebufferKind>;
using GlProgram = GlObject<GlProgramKind>;

}  // namespace stereonav
