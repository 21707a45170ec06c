// Triangles, materials and base colour textures out of a glTF file.
#include "engine/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <map>

#include "engine/base/error.h"
#include "engine/base/memory_parts.h"
#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

constexpr const char* kMeshAdvice = "export the mesh again";
constexpr std::size_t kMaxVertices = 1u << 30;
constexpr std::size_t kTellEach = 1u << 16;  // vertices
constexpr std::size_t kTellEachPart = 64;
constexpr double kTexelBytes = sizeof(PackedColor) * 4.0 / 3;  // with its coarser levels

// Which set of a vertex's texture coordinates is used, and its transform (KHR_texture_transform).
struct TexturePlaces {
    int set = 0;
    glm::dvec2 offset{0.0}, scale{1.0};
    double rotation = 0;  // radians, counter-clockwise with v downwards

    glm::dvec2 placed(const glm::dvec2& uv) const {
        const double c = std::cos(rotation), s = std::sin(rotation);
        const glm::dvec2 p = scale * uv;
        return offset + glm::dvec2(c * p.x + s * p.y, c * p.y - s * p.x);
    }
};

TexturePlaces texturePlacesOf(const tinygltf::TextureInfo& texture) {
    TexturePlaces places;
    places.set = std::max(texture.texCoord, 0);
    const auto found = texture.extensions.find("KHR_texture_transform");
    if (found == texture.extensions.end()) return places;
    const tinygltf::Value& given = found->second;
    const auto take = [&](const char* name, glm::dvec2& to) {
        if (!given.Has(name) || given.Get(name).ArrayLen() != 2) return;
        for (int c = 0; c < 2; ++c)
            if (given.Get(name).Get(c).IsNumber()) to[c] = given.Get(name).Get(c).GetNumberAsDouble();
    };
    take("offset", places.offset);
    take("scale", places.scale);
    if (given.Has("rotation") && given.Get("rotation").IsNumber())
        places.rotation = given.Get("rotation").GetNumberAsDouble();
    if (given.Has("texCoord") && given.Get("texCoord").IsInt())
        places.set = std::max(given.Get("texCoord").Get<int>(), 0);
    return places;
}

class MeshReader {
public:
    MeshReader(const GltfFile& file, Progress& progress)
        : mFile(file),
          mProgress(progress),
          mPictures(file.name, "leave pictures out, or make them smaller") {}

    TriangleMesh read() {
        readMaterials();
        const std::vector<MetNode> nodes = nodesOfScene(mFile);
        makeRoom(nodes);
        std::vector<glm::dmat4> sceneFromNode;
        sceneFromNode.reserve(nodes.size());
        for (const MetNode& met : nodes) {
            const glm::dmat4 placed = placementOf(mFile.model.nodes[met.node]).parentFromNode();
            sceneFromNode.push_back(met.above < 0 ? placed : sceneFromNode[met.above] * placed);
            readNode(met.node, sceneFromNode.back());
        }
        if (mMesh.triangles.empty())
            throw Error(mFile.name, "scene", "expected a mesh with triangles, found none",
                        "export a mesh with it");
        return std::move(mMesh);
    }

private:
    void makeRoom(const std::vector<MetNode>& nodes);
    void readMaterials();
    TextureWrap wrapOf(int code, const std::string& place) const;
    int readTexture(int texture, MeshMaterial& material);
    int readImage(int image, const std::string& place);
    void readNode(int node, const glm::dmat4& sceneFromNode);
    void readPrimitive(const tinygltf::Primitive& primitive, const glm::dmat4& sceneFromNode,
                       const std::string& place);
    void readVertices(const tinygltf::Primitive& primitive, const glm::dmat4& sceneFromNode,
                      const std::string& place);
    void readTriangles(const tinygltf::Primitive& primitive, std::size_t base, const std::string& place);
    std::vector<double> attribute(const tinygltf::Primitive& primitive, const std::string& name,
                                  int components, std::size_t count, const std::string& place) const;

    void tell() const;

    const GltfFile& mFile;
    Progress& mProgress;
    TriangleMesh mMesh;
    std::map<int, int> mTextures;  // the mesh's textures, by the number of their image
    MemoryParts mPictures;
    std::vector<TexturePlaces> mTexturePlaces;  // by material: places in its base colour texture
};

// A mesh that several nodes show is there several times. No accessor counts for more elements than its buffer
// has bytes for: what a file names without having it takes no memory, and is refused when it is read.
void MeshReader::makeRoom(const std::vector<MetNode>& nodes) {
    // Bytes that Embree takes for a triangle while its tree is built, beside its copy of the mesh: measured
    // 110 to 131.
    constexpr double kTreeBytes = 140;
    const auto& model = mFile.model;
    double vertices = 0, triangles = 0, most = 0;
    std::size_t parts = 0;
    for (const MetNode& met : nodes) {
        const int mesh = model.nodes[met.node].mesh;
        if (mesh < 0 || static_cast<std::size_t>(mesh) >= model.meshes.size()) continue;
        parts += model.meshes[mesh].primitives.size();
        if (parts > kMostMeshParts)
            throw Error(mFile.name, "scene", fmt::format("shows more than {} primitives", kMostMeshParts),
                        "simplify the mesh");
        for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
            const auto position = primitive.attributes.find("POSITION");
            const std::size_t own =
                position == primitive.attributes.end() ? 0 : accessorCountWithin(mFile, position->second);
            const std::size_t corners =
                primitive.indices >= 0 ? accessorCountWithin(mFile, primitive.indices) : own;
            vertices += static_cast<double>(own);
            triangles += static_cast<double>(corners) / (primitive.mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1);
            double numbers = 0;  // a vertex
            for (const auto& [attribute, components] :
                 {std::pair("POSITION", 3), {"NORMAL", 3}, {"COLOR_0", 4}, {"TEXCOORD_0", 2}})
                if (primitive.attributes.contains(attribute)) numbers += components;
            most =
                std::max(most, static_cast<double>(own) * numbers * sizeof(double) +
                                   static_cast<double>(corners) * (sizeof(double) + sizeof(std::uint32_t)));
        }
    }
    const double kept = vertices * sizeof(TriangleMesh::Vertex) + triangles * sizeof(TriangleMesh::Triangle);
    const double tree = vertices * 12 + triangles * (12 + kTreeBytes);  // once all is read
    checkMemory(mFile.name, kept + std::max(most, tree), "simplify the mesh");
    mMesh.vertices.reserve(static_cast<std::size_t>(vertices));
    mMesh.triangles.reserve(static_cast<std::size_t>(triangles));
}

void MeshReader::tell() const {
    const double all = static_cast<double>(std::max<std::size_t>(mMesh.vertices.capacity(), 1));
    mProgress.report(std::min(static_cast<double>(mMesh.vertices.size()) / all, 1.0), "reading the mesh");
}

void MeshReader::readMaterials() {
    for (const auto& source : mFile.model.materials) {
        MeshMaterial material;
        const auto& factor = source.pbrMetallicRoughness.baseColorFactor;
        if (factor.size() >= 3) material.baseColor = glm::vec3(factor[0], factor[1], factor[2]);
        const auto& texture = source.pbrMetallicRoughness.baseColorTexture;
        mTexturePlaces.push_back(texturePlacesOf(texture));
        if (texture.index >= 0) material.texture = readTexture(texture.index, material);
        mMesh.materials.push_back(material);
    }
    mMesh.materials.emplace_back();  // material of primitives without one
    mTexturePlaces.emplace_back();
}

TextureWrap MeshReader::wrapOf(int code, const std::string& place) const {
    switch (code) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return TextureWrap::Repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return TextureWrap::MirroredRepeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return TextureWrap::ClampToEdge;
        default:
            throw Error(mFile.name, place,
                        fmt::format("expected a wrap of 10497, 33071 or 33648, got {}", code), kMeshAdvice);
    }
}

int MeshReader::readTexture(int index, MeshMaterial& material) {
    const auto& model = mFile.model;
    const std::string place = fmt::format("texture {}", index);
    if (static_cast<std::size_t>(index) >= model.textures.size())
        throw Error(mFile.name, place, fmt::format("expected one of {}", model.textures.size()), kMeshAdvice);
    const tinygltf::Texture& texture = model.textures[index];
    if (texture.source < 0 || static_cast<std::size_t>(texture.source) >= model.images.size())
        throw Error(mFile.name, place, "expected a PNG or JPEG image, found none", kMeshAdvice);
    if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model.samplers.size()) {
        const tinygltf::Sampler& sampler = model.samplers[texture.sampler];
        const std::string samplerPlace = fmt::format("sampler {}", texture.sampler);
        material.wrapX = wrapOf(sampler.wrapS, samplerPlace);
        material.wrapY = wrapOf(sampler.wrapT, samplerPlace);
    }
    return readImage(texture.source, place);
}

// Each picture is decoded once, however many materials show it.
int MeshReader::readImage(int source, const std::string& place) {
    const auto [known, isNew] = mTextures.try_emplace(source, static_cast<int>(mMesh.textures.size()));
    if (!isNew) return known->second;
    const tinygltf::Image& image = mFile.model.images[source];
    const std::span<const unsigned char> bytes = image.bufferView >= 0
                                                     ? bufferViewBytes(mFile, image.bufferView, place)
                                                     : std::span(mFile.imageBytes[source]);
    const Plane<PackedColor> picture = decodeColorImage(bytes, mFile.name, fmt::format("image {}", source));
    mPictures.take(kTexelBytes * picture.width() * picture.height());
    mMesh.textures.emplace_back(picture, glm::dvec2(0), glm::dvec2(1));
    return known->second;
}

void MeshReader::readNode(int node, const glm::dmat4& sceneFromNode) {
    const auto& model = mFile.model;
    const int mesh = model.nodes[node].mesh;
    if (mesh < 0) return;
    if (static_cast<std::size_t>(mesh) >= model.meshes.size())
        throw Error(mFile.name, fmt::format("node {}", node),
                    fmt::format("refers to mesh {}, the file has {}", mesh, model.meshes.size()),
                    kMeshAdvice);
    for (std::size_t p = 0; p < model.meshes[mesh].primitives.size(); ++p) {
        if (p % kTellEachPart == 0) tell();
        readPrimitive(model.meshes[mesh].primitives[p], sceneFromNode,
                      fmt::format("mesh {}, primitive {}", mesh, p));
    }
}

void MeshReader::readPrimitive(const tinygltf::Primitive& primitive, const glm::dmat4& sceneFromNode,
                               const std::string& place) {
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (!triangles) return;  // points and lines have no surface
    const std::size_t base = mMesh.vertices.size();
    readVertices(primitive, sceneFromNode, place);
    readTriangles(primitive, base, place);
}

std::vector<double> MeshReader::attribute(const tinygltf::Primitive& primitive, const std::string& name,
                                          int components, std::size_t count, const std::string& place) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return {};
    std::vector<double> values = accessorValues(mFile, found->second, components, place + ", " + name);
    if (values.size() != count * components)
        throw Error(
            mFile.name, place + ", " + name,
            fmt::format("expected {} elements as POSITION has, got {}", count, values.size() / components),
            kMeshAdvice);
    return values;
}

void MeshReader::readVertices(const tinygltf::Primitive& primitive, const glm::dmat4& sceneFromNode,
                              const std::string& place) {
    const auto found = primitive.attributes.find("POSITION");
    if (found == primitive.attributes.end())
        throw Error(mFile.name, place, "expected the attribute POSITION, found none", kMeshAdvice);
    const std::vector<double> position = accessorValues(mFile, found->second, 3, place + ", POSITION");
    const std::size_t count = position.size() / 3;
    if (count + mMesh.vertices.size() > kMaxVertices)
        throw Error(mFile.name, place, fmt::format("has more than {} vertices", kMaxVertices), "simplify it");
    const auto color = primitive.attributes.find("COLOR_0");
    const int channels = color == primitive.attributes.end()
                             ? 3
                             : accessorComponents(mFile, color->second, place + ", COLOR_0");
    const int material = primitive.material;
    const bool known = material >= 0 && static_cast<std::size_t>(material) < mTexturePlaces.size();
    const TexturePlaces places = known ? mTexturePlaces[material] : TexturePlaces();
    const std::string uvName = fmt::format("TEXCOORD_{}", places.set);
    const auto normals = attribute(primitive, "NORMAL", 3, count, place);
    const auto colors = attribute(primitive, "COLOR_0", std::max(channels, 3), count, place);
    const auto uvs = attribute(primitive, uvName, 2, count, place);
    const glm::dmat3 turn(sceneFromNode);
    const double volume = glm::determinant(turn);
    // Cofactors turn normals as the inverse transpose does, and exist for flattened nodes too.
    const glm::dmat3 turnNormal(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                                glm::cross(turn[0], turn[1]));
    for (std::size_t k = 0; k < count; ++k) {
        if (k % kTellEach == 0) tell();
        TriangleMesh::Vertex v{{}, glm::vec3(0), glm::vec3(1), glm::vec2(0)};
        const glm::dvec4 p(position[3 * k], position[3 * k + 1], position[3 * k + 2], 1);
        v.position = worldFromGltf(glm::dvec3(sceneFromNode * p));
        if (!normals.empty()) {
            const glm::dvec3 n = turnNormal *
                                 glm::dvec3(normals[3 * k], normals[3 * k + 1], normals[3 * k + 2]) *
                                 (volume < 0 ? -1. : 1.);
            const double length = glm::length(n);
            if (length > 0) v.normal = glm::vec3(worldFromGltf(n / length));
        }
        if (!colors.empty())
            v.color = glm::vec3(colors[channels * k], colors[channels * k + 1], colors[channels * k + 2]);
        if (!uvs.empty()) v.uv = glm::vec2(places.placed({uvs[2 * k], uvs[2 * k + 1]}));
        if (!std::isfinite(v.uv.x) || !std::isfinite(v.uv.y))
            throw Error(mFile.name, fmt::format("{}, {}", place, uvName),
                        fmt::format("element {} is no place of a texture", k), kMeshAdvice);
        mMesh.vertices.push_back(v);
    }
}

void MeshReader::readTriangles(const tinygltf::Primitive& primitive, std::size_t base,
                               const std::string& place) {
    const std::size_t count = mMesh.vertices.size() - base;
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
        for (const double value : accessorValues(mFile, primitive.indices, 1, place + ", indices")) {
            if (!(value >= 0 && value < static_cast<double>(count)))
                throw Error(mFile.name, place + ", indices",
                            fmt::format("expected vertices 0 to {}, got {}",
                                        static_cast<long long>(count) - 1, value),
                            kMeshAdvice);
            order.push_back(static_cast<std::uint32_t>(base + static_cast<std::size_t>(value)));
        }
    } else {
        for (std::size_t k = 0; k < count; ++k) order.push_back(static_cast<std::uint32_t>(base + k));
    }
    const int last = static_cast<int>(mMesh.materials.size()) - 1;
    if (primitive.material >= last)
        throw Error(mFile.name, place,
                    fmt::format("refers to material {}, the file has {}", primitive.material, last),
                    kMeshAdvice);
    const int material = primitive.material >= 0 ? primitive.material : last;
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && order.size() % 3 != 0)
        throw Error(mFile.name, place,
                    fmt::format("expected three indices a triangle, got {} indices", order.size()),
                    kMeshAdvice);
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::size_t step = primitive.mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t k = 0; k + 2 < order.size(); k += step)
        mMesh.triangles.push_back({{order[fan ? 0 : k], order[k + 1], order[k + 2]}, material});
}

}  // namespace

TriangleMesh readMesh(const std::filesystem::path& path, Progress& progress) {
    progress.report(0, "reading the mesh");
    const GltfFile file = readGltf(path);
    TriangleMesh mesh = MeshReader(file, progress).read();
    progress.report(1, "reading the mesh");
    return mesh;
}

TriangleMesh readMesh(const std::filesystem::path& path) {
    Progress quiet;
    return readMesh(path, quiet);
}

}  // namespace stereonav
