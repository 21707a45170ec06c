// See the header.
#include "engine/display/texture_upload.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace stereonav {

void expectAtMost(GLenum limit, int size, const char* what) {
    GLint most = 0;
    glGetIntegerv(limit, &most);
    if (size > most)
        throw Error("", what,
                    fmt::format("expected at most {} a side on this graphics card, got {}", most, size),
                    "use the CPU");
}

void expectAccepted(const char* what) {
    if (glGetError() != GL_NO_ERROR)
        throw Error("", what, "the graphics driver does not take it", "use the CPU");
}

void setFilter(GLenum kind, GLint filter, GLint wrap) {
    glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        if (kind != GL_TEXTURE_1D || axis == GL_TEXTURE_WRAP_S) glTexParameteri(kind, axis, wrap);
}

void bindTo(GLuint unit, GLenum kind, const GlTexture& texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(kind, texture.name());
}

}  // namespace stereonav
