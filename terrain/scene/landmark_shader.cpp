// Colour of landmarks. Scalar: they cover few pixels of a terrain.
#include "terrain/scene/landmark_shader.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "terrain/light/sun_and_sky.h"

namespace stereonav {
namespace {

int wrapped(int i, int size, bool repeat) {
    if (!repeat) return std::clamp(i, 0, size - 1);
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

// Bilinear, in linear light. uv: v downwards; rows of a level run upwards.
glm::vec3 sampleLevel(const ColorTexture& texture, int k, const glm::vec2& uv,
                      const LandmarkMaterial& material) {
    const auto& level = texture.level(k);
    // Whole repeats are taken off first, so that the texel number fits an integer.
    const float fx = material.repeatX ? uv.x - std::floor(uv.x) : std::clamp(uv.x, 0.0f, 1.0f);
    const float fy = material.repeatY ? uv.y - std::floor(uv.y) : std::clamp(uv.y, 0.0f, 1.0f);
    const float x = fx * static_cast<float>(level.width()) - 0.5f;
    const float y = (1 - fy) * static_cast<float>(level.height()) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const int i0 = wrapped(i, level.width(), material.repeatX),
              i1 = wrapped(i + 1, level.width(), material.repeatX);
    const int j0 = wrapped(j, level.height(), material.repeatY),
              j1 = wrapped(j + 1, level.height(), material.repeatY);
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

}  // namespace

LandmarkShader::LandmarkShader(LandmarkMesh&& mesh, const TerrainLook& look) : mMesh(std::move(mesh)) {
    setLook(look);
}

void LandmarkShader::setLook(const TerrainLook& look) {
    mSun = sunUp(std::sin(look.sunElevation)) * directionToSun(look.sunAzimuth, look.sunElevation);
    mAmbient = look.ambient;
    mFog = Fog(look);
}

void LandmarkShader::recentre(const glm::dvec3& centre) {
    for (auto& vertex : mMesh.vertices) vertex.position = glm::dvec3(glm::vec3(vertex.position - centre));
}

LandmarkHit LandmarkShader::hitAt(std::uint32_t triangle, const glm::dvec3& origin,
                                  const glm::dvec3& direction, float t) const {
    const auto& corner = mMesh.triangles[triangle].vertex;
    const glm::dvec3 a = mMesh.vertices[corner[0]].position;
    const glm::dvec3 ab = mMesh.vertices[corner[1]].position - a, ac = mMesh.vertices[corner[2]].position - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double twiceArea = glm::length(normal), along = glm::dot(direction, normal);
    LandmarkHit hit{t, triangle, {1, 0, 0}, {0, 0, 1}};
    if (!(twiceArea > 0)) return hit;
    hit.faceNormal = normal / twiceArea;
    // Along the face the plane says nothing about t, and Embree's value stands.
    if (std::abs(along) > 1e-9 * twiceArea * glm::length(direction))
        hit.t = glm::dot(a - origin, normal) / along;
    const glm::dvec3 p = origin + hit.t * direction - a;
    const double scale = 1 / (twiceArea * twiceArea);
    const double wb = std::clamp(glm::dot(glm::cross(p, ac), normal) * scale, 0.0, 1.0);
    const double wc = std::clamp(glm::dot(glm::cross(ab, p), normal) * scale, 0.0, 1.0 - wb);
    hit.weight[0] = static_cast<float>(1 - wb - wc);
    hit.weight[1] = static_cast<float>(wb);
    hit.weight[2] = static_cast<float>(wc);
    return hit;
}

// footprint: metres on the surface; the level is the one whose texels are about as large.
glm::vec3 LandmarkShader::textureColor(const LandmarkHit& hit, const LandmarkMaterial& material,
                                       double footprint) const {
    const ColorTexture& texture = mMesh.textures[material.texture];
    const auto& corner = mMesh.triangles[hit.triangle].vertex;
    const auto &a = mMesh.vertices[corner[0]], &b = mMesh.vertices[corner[1]], &c = mMesh.vertices[corner[2]];
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

PackedColor LandmarkShader::color(const LandmarkHit& hit, const glm::dvec3& direction, double pixelSize,
                                  bool throughFog) const {
    const auto& triangle = mMesh.triangles[hit.triangle];
    const auto &a = mMesh.vertices[triangle.vertex[0]], &b = mMesh.vertices[triangle.vertex[1]],
               &c = mMesh.vertices[triangle.vertex[2]];
    const LandmarkMaterial& material = mMesh.materials[triangle.material];
    const double facing = std::abs(glm::dot(hit.faceNormal, direction)) / glm::length(direction);
    glm::vec3 color = material.baseColor * blend(a.color, b.color, c.color, hit.weight);
    // A pixel is pixelSize across and longer along a slanted face: the geometric mean of both.
    if (material.texture >= 0)
        color *= textureColor(hit, material, hit.t * pixelSize / std::sqrt(std::max(facing, 0.01)));
    glm::dvec3 normal(blend(a.normal, b.normal, c.normal, hit.weight));
    const double length = glm::length(normal);
    normal = length > 1e-3 ? normal / length : hit.faceNormal;
    // Seen from behind the face, its other side is lit. The face decides: an interpolated normal may
    // turn away at a silhouette.
    const bool behind = glm::dot(hit.faceNormal, direction) > 0;
    if ((glm::dot(normal, hit.faceNormal) > 0) == behind) normal = -normal;
    const double light = mAmbient + (1 - mAmbient) * std::max(0.0, glm::dot(normal, mSun));
    color *= static_cast<float>(light);
    if (!throughFog || !mFog.any()) return packColor(color);
    return packColor(mFog.seen(glm::clamp(color, 0.0f, 1.0f), hit.t * glm::length(direction)));
}

}  // namespace stereonav
