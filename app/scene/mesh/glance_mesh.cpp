// Facts of a glTF mesh from its description: the JSON of a .gltf, or the first part of a .glb. Buffers are
// not read.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/scene/mesh/mesh_facts.h"
#include "engine/base/error.h"
#include "engine/base/regular_file.h"
#include "engine/text/json_check.h"

namespace stereonav {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kLongest = 16 << 20;  // bytes of the description
constexpr std::uint32_t kJsonPart = 0x4E4F534A;

[[noreturn]] void refuse(const std::string& file, const std::string& found) {
    throw Error(file, "", "expected a glTF 2.0 mesh, found " + found, "export the mesh again");
}

std::uint32_t wordAt(const unsigned char* bytes) {
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

std::string descriptionIn(const std::string& file) {
    RegularFile in(file);
    std::uint64_t length = in.size();
    std::array<unsigned char, 20> head{};
    if (in.read(head.data(), head.size()) == head.size() && std::memcmp(head.data(), "glTF", 4) == 0) {
        length = wordAt(&head[12]);
        if (wordAt(&head[4]) != 2 || wordAt(&head[16]) != kJsonPart) refuse(file, "another version");
        if (wordAt(&head[8]) > in.size() || length > in.size() - head.size())
            refuse(file, fmt::format("a part of it, {} bytes of {}", in.size(), wordAt(&head[8])));
    } else {
        in.seek(0);
    }
    if (length > kLongest)
        throw Error(file, "", fmt::format("its description has {} bytes, more than are looked at", length),
                    "open it");
    std::string text(length, ' ');
    if (in.read(text.data(), length) != length) refuse(file, "that it ends too early");
    checkJson(text, file, "export the mesh again");
    return text;
}

// Numbers of elements according to the file; no memory is allocated by them.
struct Counts {
    double vertices = 0, triangles = 0;
};

double countOf(const Json& model, const Json& primitive, const char* key, const char* inside = nullptr) {
    const Json* from = &primitive;
    if (inside) {
        if (!primitive.contains(inside)) return 0;
        from = &primitive[inside];
    }
    if (!from->is_object() || !from->contains(key) || !(*from)[key].is_number_unsigned()) return 0;
    const auto index = (*from)[key].get<std::size_t>();
    const auto accessors = model.find("accessors");
    if (accessors == model.end() || !accessors->is_array() || index >= accessors->size()) return 0;
    const Json& accessor = (*accessors)[index];
    return accessor.is_object() ? std::max(accessor.value("count", 0.0), 0.0) : 0;
}

Counts countsIn(const Json& model, const Json& mesh) {
    Counts counts;
    for (const Json& primitive : mesh.value("primitives", Json::array())) {
        const double own = countOf(model, primitive, "POSITION", "attributes");
        const double corners = primitive.contains("indices") ? countOf(model, primitive, "indices") : own;
        const int mode = primitive.value("mode", 4);
        counts.vertices += own;
        if (mode == 4) counts.triangles += std::floor(corners / 3);
        if (mode == 5 || mode == 6) counts.triangles += std::max(corners - 2, 0.0);
    }
    return counts;
}

std::size_t sizeOf(const Json& model, const char* key) {
    return model.contains(key) && model[key].is_array() ? model[key].size() : 0;
}

}  // namespace

Facts glanceAtMesh(const std::string& file, Progress& progress) {
    progress.report(0, "looking at the mesh");
    const std::string text = descriptionIn(file);
    progress.report(0.5, "looking at the mesh");
    const Json model = Json::parse(text, nullptr, false);
    if (!model.is_object() || !model.contains("asset")) refuse(file, "something else");
    Counts all;
    try {
        for (const Json& mesh : model.value("meshes", Json::array())) {
            const Counts counts = countsIn(model, mesh);
            all.vertices += counts.vertices, all.triangles += counts.triangles;
        }
    } catch (const Json::exception&) {
        refuse(file, "a description that is damaged");
    }
    if (!(all.triangles > 0)) refuse(file, "no triangles");
    FactList list;
    list.both("format", std::string("glTF"), "read by");
    list.both("triangles", all.triangles, "triangles",
              fmt::format("{:.0f} over {:.0f} vertices", all.triangles, all.vertices));
    list.text("parts", fmt::format("{} meshes, {} materials, {} pictures", sizeOf(model, "meshes"),
                                   sizeOf(model, "materials"), sizeOf(model, "images")));
    list.text("unit", "m");
    progress.report(1, "looking at the mesh");
    return std::move(list.facts());
}

}  // namespace stereonav
