// A medium as textures and the uniforms of shaders/medium_sample.glsl. Units of textures are fixed here and
// named in the shaders by their binding.
#pragma once

#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/shader_program.h"
#include "engine/medium/model/medium.h"

namespace stereonav {

// Texture units; the shaders name them by their binding.
struct GlUnit {
    static constexpr GLuint kField = 0, kTable = 1, kNoise = 2, kPhase = 3, kBefore = 4, kBaked = 5,
                            kBeyond = 6,
                            kHeights = 8,  // one a layer from there on
        kColors = 16;                      // one a layer with its own colours
};

class MediumTextures {
public:
    static constexpr int kMostLayers = 8, kMostColors = 3, kMostLevels = 16;

    // medium must outlive the textures. Throws Error where a texture would be larger than the driver allows.
    explicit MediumTextures(const Medium& medium);

    // Returns lines for the shaders that say which parts the medium has. They do not depend on the look.
    const std::string& defines() const { return mDefines; }
    bool hasGlow() const { return mHasGlow; }
    bool hasSurface() const { return mHasSurface; }

    // Sets uniforms of the medium for places relative to the anchor, at `time` seconds; the program must be
    // in use.
    void setUniforms(const ShaderProgram& program, const glm::dvec3& anchor, double time) const;
    void bind() const;

private:
    void uploadField();
    void uploadTables();
    void uploadNoise();
    void uploadLayer(const HeightLayer& layer);
    void uploadColors(const ColorTexture& color);
    void addTable(const MediumTable& table);
    void setFieldUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const;
    void setLayerUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const;
    void setColorUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const;
    void setNoiseUniforms(const ShaderProgram& program, const glm::dvec3& anchor, double time) const;

    const Medium& mMedium;
    GlTexture mField;  // R32F: stored values are 16 bit whole numbers, which it holds exactly
    GlTexture mTables;
    GlTexture mNoise;
    glm::ivec2 mTableSize{0};  // columns, rows
    GLenum mTableKind =
        GL_TEXTURE_1D_ARRAY;  // tables of one row each, read with half the taps; or GL_TEXTURE_2D_ARRAY
    // Mip levels of a layer side by side in one texture, and the place of each: corner and size.
    struct Levels {
        GlTexture texture;
        std::vector<glm::ivec4> levels;
    };
    std::vector<Levels> mHeights;  // R32F
    std::vector<Levels> mColors;   // RGB10_A2, for the layers that have their own
    bool mHasGlow = false, mHasSurface = false;
    std::string mDefines;
};

}  // namespace stereonav
