// The terrain mesh as a glTF file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/memory.h"
#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "terrain/mesh/terrain_mesh.h"

namespace stereonav {
namespace {

constexpr int kMaxTextureSide = 16384;           // what graphics cards take
constexpr int kMaxLosslessTexels = 4096 * 1024;  // above, JPEG

// The finest level that is not larger than a graphics card takes.
int levelFor(const ColorTexture& color) {
    int k = 0;
    while (std::max(color.level(k).width(), color.level(k).height()) > kMaxTextureSide) ++k;
    return k;
}

// Row 0 northernmost, as files have it.
Plane<PackedColor> pictureOf(const ColorTexture& color, int k) {
    const auto& level = color.level(k);
    Plane<PackedColor> picture(level.width(), level.height());
    for (int y = 0; y < level.height(); ++y)
        std::copy_n(level.row(level.height() - 1 - y), level.width(), picture.row(y));
    return picture;
}

void addMaterial(tinygltf::Model& model, const ColorTexture& color, int level) {
    const Plane<PackedColor> picture = pictureOf(color, level);
    const bool lossless = static_cast<long long>(picture.width()) * picture.height() <= kMaxLosslessTexels;
    tinygltf::Image image;
    image.name = "ground";
    image.mimeType = lossless ? "image/png" : "image/jpeg";
    image.bufferView = addBytes(model, encodeColorImage(picture, lossless ? ".png" : ".jpg"));
    model.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);
    tinygltf::Texture texture;
    texture.source = texture.sampler = 0;
    model.textures.push_back(texture);
    tinygltf::Material material;
    material.name = "ground";
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 1;
    material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
    model.extensionsUsed.push_back("KHR_materials_unlit");
    model.materials.push_back(material);
}

tinygltf::Primitive primitiveOf(tinygltf::Model& model, const Heightfield& ground, const ColorTexture& color,
                                int level, const TerrainMesh& mesh) {
    std::vector<float> positions, normals, uvs;
    const double coarser = 1 << level;
    const glm::dvec2 size(color.level(level).width() * coarser, color.level(level).height() * coarser);
    for (const glm::ivec2& v : mesh.vertices) {
        const glm::dvec2 grid(v), world = ground.worldFromGrid(grid);
        const glm::dvec3 p = gltfFromWorld({world, ground.sample(v.x, v.y)});
        const glm::dvec2 slope = ground.gradientAtSample(v.x, v.y);
        const glm::dvec3 n = gltfFromWorld(glm::normalize(glm::dvec3(-slope, 1.0)));
        const glm::dvec2 texel = (grid - color.gridOrigin()) / color.gridPerTexel() / size;
        for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(p[k]));
        for (int k = 0; k < 3; ++k) normals.push_back(static_cast<float>(n[k]));
        uvs.push_back(static_cast<float>(texel.x));
        uvs.push_back(static_cast<float>(1 - texel.y));
    }
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : mesh.triangles)
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    primitive.attributes["POSITION"] = addFloats(model, positions, 3, true, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] = addFloats(model, normals, 3, false, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["TEXCOORD_0"] = addFloats(model, uvs, 2, false, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = addIndices(model, indices);
    return primitive;
}

// Checks memory for what is put together at once: the numbers, the model's buffer, which has grown, and the
// file twice; of the picture its rows, filtered and compressed ones. As text (.gltf) three bytes take four
// letters.
void checkFileMemory(const std::filesystem::path& file, double texels, const TerrainMesh& mesh) {
    constexpr double kVertex = 8 * sizeof(float), kTriangle = 3 * sizeof(std::uint32_t), kTexel = 12;
    const double numbers = kVertex * static_cast<double>(mesh.vertices.size()) +
                           kTriangle * static_cast<double>(mesh.triangles.size());
    checkMemory(file.string(), (file.extension() == ".gltf" ? 7 : 5) * numbers + kTexel * texels,
                "give a larger --error");
}

tinygltf::Value valueOf(const nlohmann::ordered_json& json) {
    if (json.is_string()) return tinygltf::Value(json.get<std::string>());
    if (json.is_number()) return tinygltf::Value(json.get<double>());
    if (json.is_array()) {
        tinygltf::Value::Array values;
        values.reserve(json.size());
        for (const auto& one : json) values.push_back(valueOf(one));
        return tinygltf::Value(std::move(values));
    }
    if (!json.is_object()) return {};  // null
    tinygltf::Value::Object values;
    for (const auto& [key, one] : json.items()) values.emplace(key, valueOf(one));
    return tinygltf::Value(std::move(values));
}

// The mesh is the last to get into its place, and errors name it by that.
void writeBoth(const std::filesystem::path& file, const tinygltf::Model& model,
               const std::string& placeText) {
    writeFileAtomically(file, [&](const std::filesystem::path& temporary) {
        try {
            writeGltf(temporary, model);
        } catch (const Error& error) {
            std::string words = error.what();
            const std::string name = temporary.string();
            if (const std::size_t at = words.find(name); at != std::string::npos)
                words.replace(at, name.size(), file.string());
            throw Error("", "", words, "");
        }
        writeTextFile(meshPlaceFile(file), placeText);
    });
}

}  // namespace

bool isMeshFileName(const std::filesystem::path& file) {
    return hasGltfExtension(file);
}

void writeTerrainMesh(const std::filesystem::path& file, const Heightfield& ground, const ColorTexture& color,
                      const TerrainMesh& mesh, const MeshPlace& place) {
    if (!isMeshFileName(file))
        throw Error(file.string(), "",
                    fmt::format("expected a mesh named .glb or .gltf, got \"{}\"", file.extension().string()),
                    "give the file one of these extensions");
    if (mesh.triangles.empty()) throw Error(file.string(), "", "there is no ground to write", "");
    const int level = levelFor(color);
    checkFileMemory(file, 1.0 * color.level(level).width() * color.level(level).height(), mesh);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "stereonav";
    tinygltf::Mesh shape;
    shape.name = "terrain";
    shape.primitives.push_back(primitiveOf(model, ground, color, level, mesh));
    model.meshes.push_back(shape);
    addMaterial(model, color, level);
    tinygltf::Node node;
    node.name = "terrain";
    node.mesh = 0;
    const std::string placeText = meshPlaceText(place);
    node.extras = valueOf(nlohmann::ordered_json::parse(placeText));
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    if (hasMeshPlaceFile(file))
        writeBoth(file, model, placeText);
    else
        writeGltf(file, model);
}

}  // namespace stereonav
