// Functions common to uploads of textures: limits and failures as Errors, filters, binding to a unit.
#pragma once

#include "engine/display/gl_object.h"

namespace stereonav {

// Throws Error, named `what`, where size is above the driver's `limit` (GL_MAX_TEXTURE_SIZE, ..).
void expectAtMost(GLenum limit, int size, const char* what);
// Throws Error, named `what`, where the driver has refused something since glGetError was last asked.
void expectAccepted(const char* what);

// Sets filter and wrapping of the texture that is bound to GL_TEXTURE_1D, .. `kind`, along all its axes.
void setFilter(GLenum kind, GLint filter, GLint wrap);
void bindTo(GLuint unit, GLenum kind, const GlTexture& texture);

}  // namespace stereonav
