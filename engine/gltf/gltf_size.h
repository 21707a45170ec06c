// The memory that a glTF file's description would take as tinygltf's model, estimated before any of it is
// made: `{},` in a list is three bytes in the file, and more than a thousand in the model.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereonav {

constexpr std::size_t kMostGltfObjects = 2'000'000;  // what stands in braces: nodes, meshes, primitives...
constexpr std::size_t kMostGltfMaterials = 100'000;  // each takes ten times the time and memory of a node

// json: the description. binary: bytes of the .glb's own buffer, which each buffer without a file copies; 0
// where there is none. Throws Error naming the file where it is too deep, or takes more memory than there is.
void checkGltfSize(std::string_view json, std::size_t binary, const std::string& file);

}  // namespace stereonav
