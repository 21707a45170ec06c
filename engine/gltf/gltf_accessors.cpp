// Reads numbers of glTF accessors: plain ones, sparse ones, and zeros where a file has no data for them (glTF
// 2.0, 3.6.2). Offsets and sizes are tested against the buffer before memory is taken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/gltf/gltf_file.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostWithoutData = 1u << 22;  // largest number of elements without data in the file

double numberAt(const unsigned char* at, int componentType, bool normalized) {
    const auto read = [&]<typename T>(T value, double scale) {
        std::memcpy(&value, at, sizeof value);
        return normalized ? std::max(static_cast<double>(value) / scale, -1.0) : static_cast<double>(value);
    };
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read(std::int8_t{}, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read(std::uint8_t{}, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read(std::int16_t{}, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read(std::uint16_t{}, 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read(std::uint32_t{}, 4294967295.0);
        default: {
            float value = 0;
            std::memcpy(&value, at, sizeof value);
            return value;
        }
    }
}

bool isKnownComponentType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
            type != TINYGLTF_COMPONENT_TYPE_INT);
}

const tinygltf::Accessor& accessorAt(const GltfFile& file, int index, const std::string& place) {
    if (index < 0 || static_cast<std::size_t>(index) >= file.model.accessors.size())
        throw Error(file.name, place,
                    fmt::format("refers to accessor {}, the file has {}", index, file.model.accessors.size()),
                    "export the file again");
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    if (!isKnownComponentType(accessor.componentType))
        throw Error(file.name, fmt::format("accessor {}", index),
                    fmt::format("expected a component type of 5120 to 5126, got {}", accessor.componentType),
                    "export the file again");
    return accessor;
}

std::size_t componentBytes(int type) {
    return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

// The place of elements in a buffer view.
struct ElementRun {
    int bufferView = -1;
    std::size_t byteOffset = 0, count = 0, size = 0, stride = 0;  // size, stride: bytes
};

// Returns the bytes of a buffer view from the first element on. Throws Error unless all elements lie inside.
std::span<const unsigned char> elementBytes(const GltfFile& file, const ElementRun& run,
                                            const std::string& place) {
    const auto bytes = bufferViewBytes(file, run.bufferView, place);
    const bool fits = run.byteOffset <= bytes.size() && run.size <= bytes.size() - run.byteOffset &&
                      (run.count - 1) <= (bytes.size() - run.byteOffset - run.size) / run.stride;
    if (!fits)
        throw Error(
            file.name, place,
            fmt::format("expected {} elements of {} bytes, stride {} from byte {}, inside a buffer view of "
                        "{} bytes",
                        run.count, run.size, run.stride, run.byteOffset, bytes.size()),
            "the file is damaged: export it again");
    return bytes.subspan(run.byteOffset);
}

// Returns the run of elements that follow each other without gaps.
ElementRun packedRun(int bufferView, int byteOffset, std::size_t count, std::size_t size) {
    return {bufferView, static_cast<std::size_t>(byteOffset), count, size, size};
}

std::vector<double> plainValues(const GltfFile& file, int index, std::size_t components) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const std::string place = fmt::format("accessor {}", index);
    const auto ask = [&] {  // called once the file is known to have the data, or to need none
        checkMemory(file.name, static_cast<double>(accessor.count * components * sizeof(double)),
                    "split the model");
    };
    if (accessor.bufferView < 0) {
        if (accessor.count > kMostWithoutData)
            throw Error(file.name, place,
                        fmt::format("expected at most {} elements where there is no data for them, got {}",
                                    kMostWithoutData, accessor.count),
                        "export it with a buffer view");
        ask();
        return std::vector<double>(accessor.count * components, 0.0);
    }
    const std::size_t each = componentBytes(accessor.componentType), size = each * components;
    const auto& views = file.model.bufferViews;
    const std::size_t given = static_cast<std::size_t>(accessor.bufferView) < views.size()
                                  ? views[accessor.bufferView].byteStride
                                  : 0;
    const std::size_t stride = given != 0 ? given : size;
    const auto bytes =
        elementBytes(file, {accessor.bufferView, accessor.byteOffset, accessor.count, size, stride}, place);
    ask();
    std::vector<double> values;
    values.reserve(accessor.count * components);
    for (std::size_t e = 0; e < accessor.count; ++e)
        for (std::size_t c = 0; c < components; ++c)
            values.push_back(
                numberAt(&bytes[e * stride + c * each], accessor.componentType, accessor.normalized));
    return values;
}

// Writes the elements of a sparse accessor over those values that its indices name.
void takeSparse(const GltfFile& file, int index, std::size_t components, std::vector<double>& values) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const auto& sparse = accessor.sparse;
    const std::string place = fmt::format("accessor {}, sparse", index);
    const auto damaged = [&](const std::string& problem) {
        return Error(file.name, place, problem, "the file is damaged: export it again");
    };
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count)
        throw damaged(fmt::format("expected 1 to {} elements, got {}", accessor.count, sparse.count));
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw damaged("expected offsets of 0 bytes or more");
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        throw damaged(fmt::format("expected indices of type 5121, 5123 or 5125, got {}", type));
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t indexSize = componentBytes(type), each = componentBytes(accessor.componentType);
    const auto indices = elementBytes(
        file, packedRun(sparse.indices.bufferView, sparse.indices.byteOffset, count, indexSize), place);
    const auto given = elementBytes(
        file, packedRun(sparse.values.bufferView, sparse.values.byteOffset, count, each * components), place);
    for (std::size_t n = 0; n < count; ++n) {
        const auto element = static_cast<std::size_t>(numberAt(&indices[n * indexSize], type, false));
        if (element >= accessor.count)
            throw damaged(fmt::format("expected elements 0 to {}, got {}", accessor.count - 1, element));
        for (std::size_t c = 0; c < components; ++c)
            values[element * components + c] =
                numberAt(&given[(n * components + c) * each], accessor.componentType, accessor.normalized);
    }
}

}  // namespace

int accessorComponents(const GltfFile& file, int accessor, const std::string& place) {
    return tinygltf::GetNumComponentsInType(
        static_cast<std::uint32_t>(accessorAt(file, accessor, place).type));
}

std::vector<double> accessorValues(const GltfFile& file, int index, int components,
                                   const std::string& place) {
    const tinygltf::Accessor& accessor = accessorAt(file, index, place);
    const int found = accessorComponents(file, index, place);
    if (found != components)
        throw Error(
            file.name, place,
            fmt::format("expected {} numbers an element, accessor {} has {}", components, index, found),
            "export the file again");
    if (accessor.count == 0) return {};
    const auto width = static_cast<std::size_t>(components);
    std::vector<double> values = plainValues(file, index, width);
    if (accessor.sparse.isSparse) takeSparse(file, index, width, values);
    for (std::size_t n = 0; n < values.size(); ++n)
        if (!std::isfinite(values[n]))
            throw Error(file.name, place,
                        fmt::format("element {} of accessor {} is not a finite number", n / width, index),
                        "remove NaN and infinite values");
    return values;
}

std::size_t accessorCountWithin(const GltfFile& file, int index) {
    const auto& model = file.model;
    const auto holds = [](int at, const auto& list) {
        return at >= 0 && static_cast<std::size_t>(at) < list.size();
    };
    if (!holds(index, model.accessors)) return 0;
    const tinygltf::Accessor& accessor = model.accessors[index];
    const int component = tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(accessor.componentType));
    const int components = tinygltf::GetNumComponentsInType(static_cast<unsigned>(accessor.type));
    if (component <= 0 || components <= 0) return 0;
    if (accessor.bufferView < 0) return std::min(accessor.count, kMostWithoutData);
    if (!holds(accessor.bufferView, model.bufferViews)) return 0;
    const int buffer = model.bufferViews[accessor.bufferView].buffer;
    if (!holds(buffer, model.buffers)) return 0;
    const std::size_t bytes = static_cast<std::size_t>(component) * static_cast<std::size_t>(components);
    return std::min<std::size_t>(accessor.count, model.buffers[buffer].data.size() / bytes);
}

}  // namespace stereonav
