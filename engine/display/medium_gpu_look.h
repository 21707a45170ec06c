// Textures of a look: its phase function, and baked light for surfaces.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/shader_program.h"
#include "engine/medium/model/medium_look.h"

namespace stereonav {

// Texture of a phase function. Its coordinate is the sine of half the angle up to the right angle, and beyond
// it sqrt(2) minus the cosine of half the angle: steps of about equal angle, without trigonometry in the
// shader.
class PhaseTexture {
public:
    void set(const PhaseFunction& phase);  // uploads where it differs from what was set last
    void bind() const;
    static glm::vec2 scale();  // texture coordinate of x = x * scale().x + scale().y

private:
    GlTexture mTexture;               // RGB32F
    std::vector<glm::vec3> mEntries;  // the entries that were set, as in PhaseFunction
};

// Baked light as light times weight in rgb, and the weight in a, so that trilinear filtering gives the
// weighted mean times the sum of the weights. Texels are those at the time when a volume is first set.
class BakedTexture {
public:
    // Uploads the light. Throws Error where it does not fit. Null: no light.
    void set(const std::shared_ptr<const IlluminationVolume>& light);
    bool any() const { return mLight != nullptr; }
    void bind(GLuint unit) const;
    // name: the uniform that receives the mapping from places relative to the anchor to texture coordinates;
    // the program must be in use.
    void setPlace(const ShaderProgram& program, const char* name, const glm::dvec3& anchor) const;

private:
    void upload();

    std::unique_ptr<GlTexture> mTexture;  // RGBA16F
    std::shared_ptr<const IlluminationVolume> mLight;
};

}  // namespace stereonav
