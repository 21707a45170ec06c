// A look's textures: its phase function, and baked light for surfaces.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/shader_program.h"
#include "engine/medium/model/medium_look.h"

namespace stereonav {

// A phase function's texture by the half angle's sine up to the right angle, beyond it by sqrt(2) - its
// cosine: even steps of about the same angle, no trigonometry in the shader.
class PhaseTexture {
public:
    void set(const PhaseFunction& phase);  // uploads where it differs from what was set last
    void bind() const;
    static glm::vec2 scale();  // texture coordinate of x = x * scale().x + scale().y

private:
    GlTexture mTexture;               // RGB32F
    std::vector<glm::vec3> mEntries;  // the entries that were set, as in PhaseFunction
};

// Baked light as light times weight in rgb, the weight in a: what a trilinear filter adds up is the weighted
// mean, times the sum of the weights. Texels are those of the time when a volume is first set.
class BakedTexture {
public:
    // Uploads the light. Throws Error where it does not fit. Null: none.
    void set(const std::shared_ptr<const IlluminationVolume>& light);
    bool any() const { return mLight != nullptr; }
    void bind(GLuint unit) const;
    // `name`: the uniform that gets texture coordinates of places relative to the anchor; the program is in
    // use.
    void setPlace(const ShaderProgram& program, const char* name, const glm::dvec3& anchor) const;

private:
    void upload();

    std::unique_ptr<GlTexture> mTexture;  // RGBA16F
    std::shared_ptr<const IlluminationVolume> mLight;
};

}  // namespace stereonav
