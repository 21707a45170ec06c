#include "tests/fuzz/readers.h"

#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "app/report/json.h"
#include "app/scene/volume/findings_words.h"
#include "colon/scene/colon_cache.h"
#include "colon/study/picture_decoder.h"
#include "colon/study/study.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/helper_socket.h"
#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/image/decoded_picture.h"
#include "engine/image/image_file.h"
#include "engine/image/picture_format.h"
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

void pictureHead(const fs::path& file) {
    const std::string content = readTextFile(file);
    if (const auto format = pictureFormatOf(content)) pictureHeadOf(*format, content);
}

// What a helper that a file has taken over may send, from its first byte on, and then its end.
void helperAnswer(const fs::path& file) {
    constexpr std::uint64_t kSide = 4, kMost = 4 * kSide * kSide;
    const std::string content = readTextFile(file);
    int sockets[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) return;
    HelperSocket program(sockets[0]);
    const bool said =
        write(sockets[1], content.data(), content.size()) == static_cast<ssize_t>(content.size());
    shutdown(sockets[1], SHUT_WR);
    HelperAnswer answer;
    const auto until = HelperSocket::Time::clock::now() + std::chrono::minutes(1);
    const HelperSocket::Fate fate = program.ask("", kMost, until, answer);
    close(sockets[1]);
    if (!said || fate != HelperSocket::Fate::Whole || answer.kind != HelperAnswer::Kind::Given) return;
    const auto pixels = pixelsOf(answer.text, kSide * kSide);
    if (pixels && pixels->bytes.size() * 8 != kSide * kSide * static_cast<std::uint64_t>(pixels->bits))
        std::abort();
    const auto picture = decodedPictureOf(answer.text, {kSide, 1, 2});
    if (picture &&
        picture->samples.size() !=
            static_cast<std::uint64_t>(3 * picture->width * picture->height * picture->sampleBytes))
        std::abort();
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

// The raster that a virtual one names, or that metadata lies beside.
fs::path gridBeside(const fs::path& file) {
    const fs::path grid = file.parent_path() / "grid.asc";
    if (!fs::exists(grid))
        writeTextFile(grid,
                      "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n1 2 3\n4 5 6\n");
    return grid;
}

void heights(const fs::path& file) {
    Progress progress;
    readDem(file, 1.0, progress);
}

constexpr Reader kReaders[] = {
    {"scene", "scene.toml", [](const fs::path& file) { readSceneFile(file); }},
    {"path-text", "flight.path", [](const fs::path& file) { readPath(file); }},
    {"path-gltf", "flight.gltf", [](const fs::path& file) { readPath(file); }},
    {"landmark", "landmark.glb", [](const fs::path& file) { readMesh(file); }},
    {"probe", "probe.hdr", [](const fs::path& file) { readLinearImage(file); }},
    {"picture", "picture.png", [](const fs::path& file) { readColorImage(file); }},
    {"picture-head", "picture.png", pictureHead},
    {"helper-answer", "answer.bin", helperAnswer},
    {"transfer", "transfer.txt", [](const fs::path& file) { readTransferFunction(file); }},
    {"medium", "medium.txt", [](const fs::path& file) { readMediumTransfer(file); }},
    {"phase", "phase.txt", [](const fs::path& file) { findPhaseFunction(file.string()); }},
    {"noise", "noise.txt", [](const fs::path& file) { parseNoise(readTextFile(file), file.string()); }},
    {"nrrd", "study.nrrd", study},
    {"nifti", "study.nii", study},
    {"nifti-gz", "study.nii.gz", study},
    {"metaimage", "study.mha", study},
    {"dicom", "study.dcm", study},
    {"raster", "ground.tif", heights},
    {"raster-vrt", "ground.vrt",
     [](const fs::path& file) {
         gridBeside(file);
         heights(file);
     }},
    {"findings", "findings.json", [](const fs::path& file) { readFindings(file); }},
    {"report", "report.json", [](const fs::path& file) { readEarlierReport(file); }},
    {"raster-aux", "grid.asc.aux.xml", [](const fs::path& file) { heights(gridBeside(file)); }},
    {"track", "track.gpx", [](const fs::path& file) { readTrackFile(file); }},
    {"lines", "lines.geojson", [](const fs::path& file) { readTrackFile(file); }},
    {"bake", "light.bake", bake, mendBake},
    {"ground-light", "light.tlight", [](const fs::path& file) { loadTerrainLight(file, nullptr); }},
    {"colon-cache", "stereonav/colon-v7-0000000000000001.bin", colonCache, mendColonCache},
};

}  // namespace

std::span<const Reader> readers() {
    return kReaders;
}

}  // namespace stereonav::fuzz
