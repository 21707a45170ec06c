// Functions for uploads of textures: limits and failures as Errors, filters, binding to a unit.
#pragma once

#include "engine/display/gl_object.h"

namespace stereonav {

// Throws Error, named `what`, where size is above the driver's `limit` (GL_MAX_TEXTURE_SIZE, ..).
void expectAtMost(GLenum limit, int size, const char* what);
// Throws Error, named `what`, where the driver reported an error since the last call of glGetError.
void expectAccepted(const char* what);

// Sets filter and wrapping, along all axes, of the texture that is bound to `kind` (GL_TEXTURE_1D, ..).
void setFilter(GLenum kind, GLint filter, GLint wrap);
void bindTo(GLuint unit, GLenum kind, const GlTexture& texture);

}  // namespace stereonav
