// Writing glTF: one buffer, to which accessors and pictures are appended on 4-byte boundaries.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/gltf/gltf_file.h"

namespace stereonav {
namespace {

int typeOf(int components) {
    return components == 1   ? TINYGLTF_TYPE_SCALAR
           : components == 2 ? TINYGLTF_TYPE_VEC2
           : components == 3 ? TINYGLTF_TYPE_VEC3
                             : TINYGLTF_TYPE_VEC4;
}

template <typename T>
std::span<const unsigned char> bytesOf(std::span<const T> values) {
    return {reinterpret_cast<const unsigned char*>(values.data()), values.size_bytes()};
}

}  // namespace

int addBytes(tinygltf::Model& model, std::span<const unsigned char> bytes, int target) {
    if (model.buffers.empty()) model.buffers.emplace_back();
    auto& data = model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    data.insert(data.end(), bytes.begin(), bytes.end());
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
}

int addFloats(tinygltf::Model& model, std::span<const float> elements, int components, bool bounds,
              int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addBytes(model, bytesOf(elements), target);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = typeOf(components);
    accessor.count = elements.size() / components;
    if (bounds) {
        accessor.minValues.assign(components, std::numeric_limits<double>::infinity());
        accessor.maxValues.assign(components, -std::numeric_limits<double>::infinity());
        for (std::size_t k = 0; k < elements.size(); ++k) {
            double& low = accessor.minValues[k % components];
            double& high = accessor.maxValues[k % components];
            low = std::min<double>(low, elements[k]);
            high = std::max<double>(high, elements[k]);
        }
    }
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

int addIndices(tinygltf::Model& model, std::span<const std::uint32_t> indices) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addBytes(model, bytesOf(indices), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = indices.size();
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

void writeGltf(const std::filesystem::path& file, const tinygltf::Model& model) {
    // The JSON beside the buffer stays far below the 16 MiB left for it.
    constexpr std::size_t kMaxBufferBytes = std::numeric_limits<std::uint32_t>::max() - (16u << 20);
    if (!model.buffers.empty() && model.buffers[0].data.size() > kMaxBufferBytes)
        throw Error(file.string(), "", "would be larger than 4 GiB, the limit of glTF",
                    "ask for a coarser mesh");
    const bool binary = file.extension() == ".glb" || file.extension() == ".GLB";
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, out, /*prettyPrint=*/!binary, binary))
        throw Error(file.string(), "", "the glTF could not be composed", "");
    writeTextFile(file, std::move(out).str());
}

}  // namespace stereonav
