// Uploads of what a look brings.
#include "engine/display/medium_gpu_look.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include "engine/display/medium_gpu_textures.h"
#include "engine/display/texture_upload.h"

namespace stereonav {
namespace {

constexpr int kPhaseSteps = 4096;
constexpr double kRootOf2 = 1.4142135623730951;

}  // namespace

void PhaseTexture::set(const PhaseFunction& phase) {
    if (phase.entries() == mEntries) return;
    mEntries = phase.entries();
    std::vector<glm::vec3> texels(kPhaseSteps + 1);
    for (int i = 0; i <= kPhaseSteps; ++i) {
        const double x = kRootOf2 * i / kPhaseSteps, back = kRootOf2 - x;
        const double cosine = 2 * i <= kPhaseSteps ? 1 - 2 * x * x : 2 * back * back - 1;
        texels[static_cast<std::size_t>(i)] = phase.at(static_cast<float>(cosine));
    }
    glBindTexture(GL_TEXTURE_1D, mTexture.name());
    glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB32F, kPhaseSteps + 1, 0, GL_RGB, GL_FLOAT, texels.data());
    setFilter(GL_TEXTURE_1D, GL_LINEAR, GL_CLAMP_TO_EDGE);
}

void PhaseTexture::bind() const {
    bindTo(GlUnit::kPhase, GL_TEXTURE_1D, mTexture);
}

glm::vec2 PhaseTexture::scale() {
    constexpr double kTexels = kPhaseSteps + 1;
    return {static_cast<float>(kPhaseSteps / kRootOf2 / kTexels), static_cast<float>(0.5 / kTexels)};
}

void BakedTexture::set(const std::shared_ptr<const IlluminationVolume>& light) {
    if (light == mLight) return;
    mTexture.reset();
    mLight = nullptr;
    if (!light || light->empty()) return;
    mTexture = std::make_unique<GlTexture>();
    mLight = light;
    upload();
}

void BakedTexture::upload() {
    const glm::ivec3 size = mLight->frame.size;
    expectAtMost(GL_MAX_3D_TEXTURE_SIZE, std::max({size.x, size.y, size.z}), "baked light");
    glBindTexture(GL_TEXTURE_3D, mTexture->name());
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_RGBA16F, size.x, size.y, size.z);
    setFilter(GL_TEXTURE_3D, GL_LINEAR, GL_CLAMP_TO_EDGE);
    expectAccepted("baked light");
    std::vector<glm::vec4> slice(static_cast<std::size_t>(size.x) * size.y);
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const PackedTexel texel = mLight->texels[mLight->layout.index(i, j, k)];
                const float weight = texelWeight(texel);
                slice[static_cast<std::size_t>(j) * size.x + i] =
                    glm::vec4(texelLight(texel) * weight, weight);
            }
        glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, k, size.x, size.y, 1, GL_RGBA, GL_FLOAT, slice.data());
    }
    expectAccepted("baked light");
}

void BakedTexture::bind(GLuint unit) const {
    if (mTexture) bindTo(unit, GL_TEXTURE_3D, *mTexture);
}

void BakedTexture::setPlace(const ShaderProgram& program, const char* name, const glm::dvec3& anchor) const {
    if (!mLight) return;
    const VolumeFrame& frame = mLight->frame;
    const glm::dvec3 size(frame.size);
    const glm::dmat3 turn = glm::transpose(frame.axes);
    glm::mat4x3 fromPlace;
    for (int axis = 0; axis < 3; ++axis) fromPlace[axis] = glm::vec3(turn[axis] / frame.spacing / size);
    fromPlace[3] = glm::vec3((frame.voxelFromWorld(anchor) + 0.5) / size);
    glUniformMatrix4x3fv(program.location(name), 1, GL_FALSE, glm::value_ptr(fromPlace));
}

}  // namespace stereonav
