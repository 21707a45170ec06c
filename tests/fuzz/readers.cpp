#include "tests/fuzz/readers.h"

#include <cstddef>
#include <cstring>

#include "app/command/findings_words.h"
#include "app/report/json.h"
#include "colon/centreline/centreline.h"
#include "colon/scene/colon_cache.h"
#include "colon/study/study.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/image/image_file.h"
#include "engine/image/radiance_file.h"
#include "engine/light/bake/bake_file.h"
#include "engine/medium/model/medium_transfer.h"
#include "engine/medium/model/noise_file.h"
#include "engine/medium/model/phase_function.h"
#include "engine/mesh/mesh_file.h"
#include "engine/volume/transfer_function.h"
#include "terrain/light/terrain_light.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/raster_file.h"
#include "terrain/read/scene_file.h"

namespace stereonav::fuzz {
namespace {
namespace fs = std::filesystem;
using Bytes = std::span<std::uint8_t>;

constexpr std::uint64_t kCacheKey = 1;

void study(const fs::path& file) {
    Progress progress;
    readStudy(file, {}, progress);
}

void bake(const fs::path& file) {
    std::string problem;
    readBakeFile(file, std::nullopt, problem);
}

void colonCache(const fs::path&) {
    bool damaged = false;
    readColonCache(kCacheKey, damaged);
}

void set(Bytes input, std::size_t at, std::uint64_t value) {
    if (input.size() >= at + sizeof value) std::memcpy(input.data() + at, &value, sizeof value);
}
std::uint64_t hashOf(Bytes bytes) {
    return Hash().add(bytes.data(), bytes.size()).value();
}

// A bake's header: its own hash at its end, of what comes before.
void mendBake(Bytes input) {
    constexpr std::size_t kHash = 224;
    if (input.size() >= kHash) set(input, kHash, hashOf(input.first(kHash)));
}

// The header of what is kept of a colon: magic, version, key, bytes and hash of the rest.
void mendColonCache(Bytes input) {
    constexpr std::size_t kHeader = 40;
    if (input.size() < kHeader) return;
    set(input, 16, kCacheKey);
    set(input, 24, input.size() - kHeader);
    set(input, 32, hashOf(input.subspan(kHeader)));
}

constexpr Reader kReaders[] = {
    {"scene", "scene.toml", [](const fs::path& file) { readSceneFile(file); }},
    {"path-text", "flight.path", [](const fs::path& file) { readPath(file); }},
    {"path-gltf", "flight.gltf", [](const fs::path& file) { readPath(file); }},
    {"landmark", "landmark.glb", [](const fs::path& file) { readMesh(file); }},
    {"probe", "probe.hdr", [](const fs::path& file) { readRadianceImage(file); }},
    {"picture", "picture.png", [](const fs::path& file) { readColorImage(file); }},
    {"transfer", "transfer.txt", [](const fs::path& file) { readTransferFunction(file); }},
    {"medium", "medium.txt", [](const fs::path& file) { readMediumTransfer(file); }},
    {"phase", "phase.txt", [](const fs::path& file) { findPhaseFunction(file.string()); }},
    {"noise", "noise.txt", [](const fs::path& file) { parseNoise(readTextFile(file), file.string()); }},
    {"line-text", "line.txt", [](const fs::path& file) { readCentreline(file); }},
    {"line-vtp", "line.vtp", [](const fs::path& file) { readCentreline(file); }},
    {"line-vtk", "line.vtk", [](const fs::path& file) { readCentreline(file); }},
    {"nrrd", "study.nrrd", study},
    {"nifti", "study.nii", study},
    {"nifti-gz", "study.nii.gz", study},
    {"metaimage", "study.mha", study},
    {"dicom", "study.dcm", study},
    {"raster", "ground.tif",
     [](const fs::path& file) {
         Progress progress;
         readDem(file, 1.0, progress);
     }},
    {"findings", "findings.json", [](const fs::path& file) { readFindings(file); }},
    {"report", "report.json", [](const fs::path& file) { readEarlierReport(file); }},
    {"track", "track.gpx", [](const fs::path& file) { readTrackFile(file); }},
    {"bake", "light.bake", bake, mendBake},
    {"ground-light", "light.tlight", [](const fs::path& file) { loadTerrainLight(file, nullptr); }},
    {"colon-cache", "stereonav/colon-v7-0000000000000001.bin", colonCache, mendColonCache},
};

}  // namespace

std::span<const Reader> readers() {
    return kReaders;
}

}  // namespace stereonav::fuzz
