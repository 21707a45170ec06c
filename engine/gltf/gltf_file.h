// glTF files through tinygltf, which parses the JSON and the chunks and leaves the rest to us: checked
// access to accessors (strides, normalised integers), node transforms, and writing. Used for camera
// paths, landmark meshes and the terrain mesh; include it in .cpp files only (tiny_gltf.h is large).
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace stereonav {

// Spaces: glTF is y up, the world z up; both are right-handed and in metres.
inline glm::dvec3 worldFromGltf(const glm::dvec3& p) {
    return {p.x, -p.z, p.y};
}
inline glm::dvec3 gltfFromWorld(const glm::dvec3& p) {
    return {p.x, p.z, -p.y};
}

// A glTF file that was read.
struct GltfFile {
    std::string name;  // for messages
    tinygltf::Model model;
    // Encoded bytes of images that are files or data URIs of their own; those in a buffer view are
    // taken with bufferViewBytes().
    std::vector<std::vector<unsigned char>> imageBytes;
};

// Reads .glb or .gltf (told apart by content), and files that it names in its folder or below. What it
// describes is held against the memory first (gltf_size.h). Throws Error naming the file and what is wrong.
GltfFile readGltf(const std::filesystem::path& file);

// Returns whether a name ends like a glTF file's: .gltf or .glb, in any case.
bool hasGltfExtension(const std::filesystem::path& file);

// Returns an accessor's elements as numbers, `components` a piece; normalised integers become [0, 1] or [-1,
// 1]. Sparse ones too; what a file has no data for is 0. Throws Error with `place` unless the accessor
// exists, has that many components, lies inside its buffer, and every value is finite.
std::vector<double> accessorValues(const GltfFile& file, int accessor, int components,
                                   const std::string& place);
// Returns the components of an accessor's elements (3 for VEC3); throws Error when there is no such accessor.
int accessorComponents(const GltfFile& file, int accessor, const std::string& place);
// Returns how many elements accessorValues() may give: no more than the accessor's buffer has bytes for, 0
// where there is no such accessor.
std::size_t accessorCountWithin(const GltfFile& file, int accessor);

// Returns the bytes of a buffer view; throws Error with `place` where it is not in its buffer.
std::span<const unsigned char> bufferViewBytes(const GltfFile& file, int bufferView,
                                               const std::string& place);

// Translation, rotation and scale of a node; a matrix is used as it is when given.
struct NodePlacement {
    glm::dvec3 translation{0.0};  // metres, from the parent
    glm::dquat rotation = glm::dquat(1, 0, 0, 0);
    glm::dvec3 scale{1.0};  // factors along the node's axes
    bool hasMatrix = false;
    glm::dmat4 matrix{1.0};

    glm::dmat4 parentFromNode() const;
};
NodePlacement placementOf(const tinygltf::Node& node);

// A node as it is met on the way down from the roots.
struct MetNode {
    int node = 0;
    int above = -1;  // place in the list of the one that it hangs on; -1: it is a root
};
// Returns the nodes of the default scene (of all roots when there is none), parents before children. Throws
// Error on loops and indices out of range.
std::vector<MetNode> nodesOfScene(const GltfFile& file);

// Appends data to buffer 0 as a new accessor and returns its index. elements: components * count
// floats; bounds: write min and max (needed for positions and animation times).
int addFloats(tinygltf::Model& model, std::span<const float> elements, int components, bool bounds,
              int target = 0);
// Appends indices to buffer 0 as a new accessor and returns its index.
int addIndices(tinygltf::Model& model, std::span<const std::uint32_t> indices);
// Appends raw bytes to buffer 0 and returns the new buffer view.
int addBytes(tinygltf::Model& model, std::span<const unsigned char> bytes, int target = 0);

// Writes by extension: .glb binary, .gltf text with the buffers embedded. Throws Error naming the file where
// it can not be written, or would be larger than 4 GiB.
void writeGltf(const std::filesystem::path& file, const tinygltf::Model& model);

}  // namespace stereonav
