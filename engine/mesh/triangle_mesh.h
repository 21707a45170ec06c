// Triangles with the colour of their surface, in one list.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/color_texture.h"

namespace stereonav {

// Continuation of a texture beyond its borders.
enum class TextureWrap { Repeat, MirroredRepeat, ClampToEdge };

struct MeshMaterial {
    glm::vec3 baseColor{1.0f};  // linear
    int texture = -1;           // index into textures, -1 for none
    TextureWrap wrapX = TextureWrap::Repeat, wrapY = TextureWrap::Repeat;
};

struct TriangleMesh {
    struct Vertex {
        glm::dvec3 position;  // metres, z up
        glm::vec3 normal;     // unit, or zero where the file gives none: then the face's is used
        glm::vec3 color;      // linear, multiplies the base colour
        glm::vec2 uv;         // v downwards, as in glTF
    };
    struct Triangle {
        std::uint32_t vertex[3];
        int material;
    };
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<MeshMaterial> materials;
    std::vector<ColorTexture> textures;  // grid coordinates are texels
};

}  // namespace stereonav
