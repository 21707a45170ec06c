#include "app/scene/scene_type_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <utility>

#include "app/scene/medium/medium_type.h"
#include "app/scene/mesh/mesh_type.h"
#include "app/scene/terrain/terrain_type.h"
#include "app/scene/volume/volume_type.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

// Throws Error for archives, in which studies are often sent. Zipped SRTM tiles are read as they are.
void refuseArchive(const std::string& name) {
    if (name.ends_with(".hgt.zip") || name.ends_with(".HGT.ZIP")) return;
    std::error_code code;
    if (!std::filesystem::is_regular_file(name, code)) return;
    char head[6] = {};
    std::ifstream(name, std::ios::binary).read(head, sizeof head);
    const std::string_view begins(head, sizeof head);
    const std::pair<std::string_view, const char*> kinds[] = {
        {{"PK\3\4", 4}, "zip"}, {{"7z\xbc\xaf\x27\x1c", 6}, "7z"}, {{"Rar!\x1a\7", 6}, "rar"}};
    for (const auto& [start, kind] : kinds)
        if (begins.starts_with(start))
            throw Error(name, "", fmt::format("expected a scene or a study, found an archive ({})", kind),
                        "unpack it, and name the file or folder that was in it");
}

}  // namespace

// Elevation models have no common signature, so their type comes last: it owns all remaining files.
std::span<const SceneType* const> sceneTypes() {
    static const std::array<const SceneType*, 4> types{&builtInMediumType(), &volumeType(), &meshType(),
                                                       &terrainType()};
    return types;
}

bool isBuiltIn(const std::string& name) {
    return std::ranges::any_of(sceneTypes(), [&](const SceneType* type) {
        return std::ranges::find(type->builtIn, name) != type->builtIn.end();
    });
}

const SceneType& sceneTypeNamed(const std::string& name) {
    constexpr const char* kAdvice =
        "name a scene file (.toml), an elevation model (.tif, .hgt, .dem, .asc, .png, or a folder of them), "
        "a CT study (a folder of DICOM slices, .dcm, .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd), a mesh (.glb, "
        ".gltf), colon, cloud, wax, or nothing for the built-in terrain";
    for (const SceneType* type : sceneTypes())
        if (std::find(type->builtIn.begin(), type->builtIn.end(), name) != type->builtIn.end()) return *type;
    std::error_code code;
    if (!std::filesystem::exists(name, code)) throw Error(name, "", "no such file", kAdvice);
    if (!std::filesystem::is_directory(name, code)) checkFileToRead(name);
    refuseArchive(name);
    for (const SceneType* type : sceneTypes())
        if (type->owns && type->owns(name)) return *type;
    std::string advice;
    for (const SceneType* type : sceneTypes())
        if (type->below && advice.empty()) advice = type->below(name);
    throw Error(
        name, "",
        "expected a file, or a folder of DICOM slices or elevation models, found a folder without any",
        advice.empty() ? kAdvice : advice);
}

}  // namespace stereonav
