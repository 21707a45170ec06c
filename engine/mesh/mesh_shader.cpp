// Colour of meshes. Scalar.
#include "engine/mesh/mesh_shader.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

// The place of 0 to 1 that is shown at `x`. Whole repeats are taken off first, so that texel numbers fit
// integers.
float placeInTexture(float x, TextureWrap wrap) {
    if (wrap == TextureWrap::ClampToEdge) return std::clamp(x, 0.0f, 1.0f);
    if (wrap == TextureWrap::Repeat) return x - std::floor(x);
    const float pair = x - 2 * std::floor(0.5f * x);  // a picture and its mirror image
    return pair > 1 ? 2 - pair : pair;
}

// The number of a texel that may lie one beyond the border. Beyond a mirror is the border's texel again.
int texelNumber(int i, int size, TextureWrap wrap) {
    if (wrap != TextureWrap::Repeat) return std::clamp(i, 0, size - 1);
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

// Returns a bilinear mean in linear light. uv: v downwards; rows of a level run upwards.
glm::vec3 sampleLevel(const ColorTexture& texture, int k, const glm::vec2& uv, const MeshMaterial& material) {
    const auto& level = texture.level(k);
    const float fx = placeInTexture(uv.x, material.wrapX), fy = placeInTexture(uv.y, material.wrapY);
    const float x = fx * static_cast<float>(level.width()) - 0.5f;
    const float y = (1 - fy) * static_cast<float>(level.height()) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const int i0 = texelNumber(i, level.width(), material.wrapX),
              i1 = texelNumber(i + 1, level.width(), material.wrapX);
    const int j0 = texelNumber(j, level.height(), material.wrapY),
              j1 = texelNumber(j + 1, level.height(), material.wrapY);
    const glm::vec3 low = glm::mix(unpackColor(level.at(i0, j0)), unpackColor(level.at(i1, j0)), u);
    const glm::vec3 high = glm::mix(unpackColor(level.at(i0, j1)), unpackColor(level.at(i1, j1)), u);
    return glm::mix(low, high, v);
}

template <typename T>
T blend(const T& a, const T& b, const T& c, const float* weight) {
    return a * weight[0] + b * weight[1] + c * weight[2];
}

float cross2(const glm::vec2& a, const glm::vec2& b) {
    return a.x * b.y - a.y * b.x;
}

// footprint: metres on the surface; the level is the one whose texels are about as large.
glm::vec3 textureColor(const TriangleMesh& mesh, const MeshHit& hit, const MeshMaterial& material,
                       double footprint) {
    const ColorTexture& texture = mesh.textures[material.texture];
    const auto& corner = mesh.triangles[hit.triangle].vertex;
    const auto &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
    const glm::vec2 size(texture.level(0).width(), texture.level(0).height());
    const double texels = std::abs(cross2((b.uv - a.uv) * size, (c.uv - a.uv) * size));
    const double metres = glm::length(glm::cross(b.position - a.position, c.position - a.position));
    const double texelsAcross = metres > 0 ? footprint * std::sqrt(texels / metres) : 1.0;
    const double level = std::clamp(std::log2(std::max(texelsAcross, 1.0)), 0.0, texture.levelCount() - 1.0);
    const int fine = static_cast<int>(level), coarse = std::min(fine + 1, texture.levelCount() - 1);
    const glm::vec2 uv = blend(a.uv, b.uv, c.uv, hit.weight);
    return glm::mix(sampleLevel(texture, fine, uv, material), sampleLevel(texture, coarse, uv, material),
                    static_cast<float>(level - fine));
}

}  // namespace

glm::vec3 colorOf(const TriangleMesh& mesh, const MeshHit& hit, const glm::dvec3& direction, double pixelSize,
                  const MeshLight& light) {
    const auto& triangle = mesh.triangles[hit.triangle];
    const auto &a = mesh.vertices[triangle.vertex[0]], &b = mesh.vertices[triangle.vertex[1]],
               &c = mesh.vertices[triangle.vertex[2]];
    const MeshMaterial& material = mesh.materials[triangle.material];
    const double facing = std::abs(glm::dot(hit.faceNormal, direction)) / glm::length(direction);
    glm::vec3 color = material.baseColor * blend(a.color, b.color, c.color, hit.weight);
    // A pixel is pixelSize across and longer along a slanted face: the geometric mean of both.
    if (material.texture >= 0)
        color *= textureColor(mesh, hit, material, hit.t * pixelSize / std::sqrt(std::max(facing, 0.01)));
    glm::dvec3 normal(blend(a.normal, b.normal, c.normal, hit.weight));
    const double length = glm::length(normal);
    normal = length > 1e-3 ? normal / length : hit.faceNormal;
    // Seen from behind the face, its other side is lit. The face decides: an interpolated normal may
    // turn away at a silhouette.
    const bool behind = glm::dot(hit.faceNormal, direction) > 0;
    if ((glm::dot(normal, hit.faceNormal) > 0) == behind) normal = -normal;
    const double cosine = (glm::dot(normal, light.toSun) + light.wrap) / (1 + light.wrap);
    const double strength = light.ambient + (1 - light.ambient) * std::max(0.0, cosine);
    return color * static_cast<float>(strength);
}

}  // namespace stereonav
