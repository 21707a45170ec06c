// A landmark's shape and colour as read from glTF: triangles of the default scene in one list, metres,
// z up, node transforms applied. Not read: skins, morphing, opacity, texture transforms, and every
// texture but the base colour's.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/color_texture.h"

namespace stereonav {

struct LandmarkMaterial {
    glm::vec3 baseColor{1.0f};  // linear
    int texture = -1;           // index into textures, -1 for none
    bool repeatX = true, repeatY = true;
};

struct LandmarkMesh {
    struct Vertex {
        glm::dvec3 position;
        glm::vec3 normal;  // unit, or zero where the file gives none: then the face's is used
        glm::vec3 color;   // linear, multiplies the base colour
        glm::vec2 uv;      // v downwards, as in glTF
    };
    struct Triangle {
        std::uint32_t vertex[3];
        int material;
    };
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<LandmarkMaterial> materials;
    std::vector<ColorTexture> textures;  // grid coordinates are texels
};

// Throws Error naming the file and the mesh or accessor; at least one triangle is returned.
LandmarkMesh readLandmarkMesh(const std::filesystem::path& file);

}  // namespace stereonav
