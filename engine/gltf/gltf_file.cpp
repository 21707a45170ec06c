// Reading and checking glTF. tinygltf trusts lengths in places (a BIN chunk may overrun the file by
// its header), so the frame of a .glb is checked here first.
#include "engine/gltf/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <set>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/memory_parts.h"
#include "engine/base/named_file.h"
#include "engine/base/regular_file.h"
#include "engine/gltf/gltf_size.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

constexpr std::size_t kMaxFileBytes = std::numeric_limits<std::uint32_t>::max();  // largest size of a .glb
constexpr std::size_t kDescriptionAt = 20;  // byte of a .glb where its first chunk has its JSON
constexpr std::size_t kDeepestNode = 1000;
constexpr std::size_t kLongestName = 60;  // bytes of what a message repeats

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

// The header, and chunks that end inside the file.
void checkBinaryFrame(const std::string& bytes, const std::string& name) {
    const auto cutOff = [&](std::size_t expected) {
        throw Error(name, "",
                    fmt::format("expected {} bytes, found {}: it is cut off", expected, bytes.size()),
                    "copy or export the file again");
    };
    if (bytes.size() < 20) cutOff(20);
    const std::size_t total = wordAt(bytes, 8);
    if (wordAt(bytes, 4) != 2)
        throw Error(name, "header", fmt::format("expected glTF version 2, found {}", wordAt(bytes, 4)),
                    "export it as glTF 2.0");
    if (bytes.size() < total) cutOff(total);
    std::size_t at = 12;
    while (at + 8 <= total) {
        const std::size_t end = at + 8 + wordAt(bytes, at);
        if (end > total)
            throw Error(name, fmt::format("chunk at byte {}", at),
                        fmt::format("expected it to end by byte {}, it ends at {}", total, end),
                        "export the file again");
        at = end;
    }
}

void checkExtensions(const GltfFile& file) {
    static const std::set<std::string> known = {"KHR_lights_punctual", "KHR_materials_unlit",
                                                "KHR_mesh_quantization", "KHR_texture_transform"};
    for (const std::string& extension : file.model.extensionsRequired)
        if (!known.contains(extension))
            throw Error(file.name, "extensionsRequired", "needs " + extension + ", which is not supported",
                        "export it without compression and extensions");
}

// Keeps the encoded bytes; decoding is left to those who need the picture.
bool keepImageBytes(tinygltf::Image* image, int index, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void* user) {
    auto& kept = *static_cast<std::vector<std::vector<unsigned char>>*>(user);
    kept.resize(std::max(kept.size(), static_cast<std::size_t>(index) + 1));
    if (image->bufferView < 0 && size > 0) kept[index].assign(bytes, bytes + size);
    return true;
}

// tinygltf's ways to files. It looks in its folder, then in the current one; given "." as the former it asks
// twice for "./" and the name, which is taken for the file's own folder alone.
class NamedFiles {
public:
    explicit NamedFiles(std::filesystem::path file)
        : mFile(std::move(file)), mMemory(mFile.string(), "split the model") {}

    tinygltf::FsCallbacks callbacks() {
        return {
            [](const std::string& path, void*) { return std::filesystem::exists(path); },
            [](const std::string& path, void* self) { return static_cast<NamedFiles*>(self)->placeOf(path); },
            [](std::vector<unsigned char>* bytes, std::string*, const std::string& path, void* self) {
                *bytes = static_cast<NamedFiles*>(self)->bytesOf(path);
                return true;
            },
            nullptr, this};
    }

private:
    std::string placeOf(const std::string& path) const {
        const std::string name = path.substr(2);
        if (name.empty()) return "";
        const auto place = fileNamedBy(mFile, name);
        if (!place)
            throw Error(mFile.string(), "",
                        fmt::format("names the file \"{}\", which is not in its own folder or below",
                                    name.substr(0, kLongestName)),
                        "put both into one folder, and name it without a path");
        return place->string();
    }
    std::vector<unsigned char> bytesOf(const std::string& path) {
        RegularFile in(path);
        mMemory.take(static_cast<double>(in.size()));
        std::vector<unsigned char> bytes(in.size());
        bytes.resize(in.read(bytes.data(), bytes.size()));
        return bytes;
    }

    std::filesystem::path mFile;
    MemoryParts mMemory;
};

std::vector<int> rootsOf(const GltfFile& file) {
    const auto& model = file.model;
    if (!model.scenes.empty()) {
        const int scene = std::max(model.defaultScene, 0);
        if (static_cast<std::size_t>(scene) >= model.scenes.size())
            throw Error(file.name, "scene", fmt::format("is {}, the file has {}", scene, model.scenes.size()),
                        "export the file again");
        return model.scenes[scene].nodes;
    }
    std::set<int> children;
    for (const auto& node : model.nodes) children.insert(node.children.begin(), node.children.end());
    std::vector<int> roots;
    for (int n = 0; n < static_cast<int>(model.nodes.size()); ++n)
        if (!children.contains(n)) roots.push_back(n);
    return roots;
}

}  // namespace

GltfFile readGltf(const std::filesystem::path& path) {
    GltfFile file{path.string(), {}, {}};
    const std::string bytes = readTextFile(path);
    if (bytes.empty()) throw Error(file.name, "", "the file is empty", "name a .gltf or .glb file");
    if (bytes.size() > kMaxFileBytes)
        throw Error(file.name, "", "is larger than 4 GiB, the limit of glTF", "split it");
    const bool binary = bytes.starts_with("glTF");
    if (binary) checkBinaryFrame(bytes, file.name);
    const std::string_view behindHead = std::string_view(bytes).substr(binary ? kDescriptionAt : 0);
    const std::string_view description = behindHead.substr(0, binary ? wordAt(bytes, 12) : bytes.size());
    checkGltfSize(description, behindHead.size() - description.size(), file.name);
    tinygltf::TinyGLTF loader;
    NamedFiles named(path);
    loader.SetFsCallbacks(named.callbacks());
    loader.SetImageLoader(keepImageBytes, &file.imageBytes);
    std::string problem, warning;
    bool loaded = false;
    const auto size = static_cast<unsigned>(bytes.size());
    try {
        loaded =
            binary
                ? loader.LoadBinaryFromMemory(&file.model, &problem, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()), size, ".")
                : loader.LoadASCIIFromString(&file.model, &problem, &warning, bytes.data(), size, ".");
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (!loaded) {
        while (!problem.empty() && std::isspace(static_cast<unsigned char>(problem.back())))
            problem.pop_back();
        throw Error(file.name, "", "is not glTF 2.0 that can be read: " + jsonProblem(problem),
                    "check that it is a complete .gltf or .glb file");
    }
    checkExtensions(file);
    file.imageBytes.resize(file.model.images.size());
    return file;
}

bool hasGltfExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

std::span<const unsigned char> bufferViewBytes(const GltfFile& file, int bufferView,
                                               const std::string& place) {
    const auto& model = file.model;
    const auto damaged = [&](const std::string& problem) {
        return Error(file.name, place, problem, "the file is damaged: export it again");
    };
    if (bufferView < 0 || static_cast<std::size_t>(bufferView) >= model.bufferViews.size())
        throw damaged(
            fmt::format("refers to buffer view {}, the file has {}", bufferView, model.bufferViews.size()));
    const tinygltf::BufferView& view = model.bufferViews[bufferView];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
        throw damaged(fmt::format("refers to buffer {}, the file has {}", view.buffer, model.buffers.size()));
    const auto& data = model.buffers[view.buffer].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        throw damaged(fmt::format("expected {} bytes from {} in buffer {}, which has {}", view.byteLength,
                                  view.byteOffset, view.buffer, data.size()));
    return std::span(data).subspan(view.byteOffset, view.byteLength);
}

glm::dmat4 NodePlacement::parentFromNode() const {
    if (hasMatrix) return matrix;
    glm::dmat4 m = glm::mat4_cast(rotation);
    for (int k = 0; k < 3; ++k) m[k] *= scale[k];
    m[3] = glm::dvec4(translation, 1.0);
    return m;
}

NodePlacement placementOf(const tinygltf::Node& node) {
    NodePlacement p;
    if (node.translation.size() == 3)
        p.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4)  // x y z w in the file, w x y z in glm
        p.rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (node.scale.size() == 3) p.scale = {node.scale[0], node.scale[1], node.scale[2]};
    p.hasMatrix = node.matrix.size() == 16;
    if (p.hasMatrix)
        for (int k = 0; k < 16; ++k) p.matrix[k / 4][k % 4] = node.matrix[k];
    return p;
}

std::vector<MetNode> nodesOfScene(const GltfFile& file) {
    const auto& nodes = file.model.nodes;
    std::vector<MetNode> met;
    struct Way {
        std::size_t at = 0, child = 0;  // place in `met`; which of its children is next
    };
    std::vector<Way> way;  // from a root down
    const auto meet = [&](int node, int above) {
        if (node < 0 || static_cast<std::size_t>(node) >= nodes.size())
            throw Error(file.name, "nodes",
                        fmt::format("refers to node {}, the file has {}", node, nodes.size()),
                        "export the file again");
        // In a tree no node is met twice, so a longer list than there are nodes is a loop or a shared child.
        if (met.size() >= nodes.size() || way.size() > kDeepestNode)
            throw Error(file.name, fmt::format("node {}", node), "is its own ancestor or has two parents",
                        "export the file again");
        way.push_back({met.size(), 0});
        met.push_back({node, above});
    };
    for (const int root : rootsOf(file)) {
        meet(root, -1);
        while (!way.empty()) {
            const std::size_t at = way.back().at;
            const std::vector<int>& children = nodes[met[at].node].children;
            if (way.back().child < children.size())
                meet(children[way.back().child++], static_cast<int>(at));
            else
                way.pop_back();
        }
    }
    return met;
}

}  // namespace stereonav
