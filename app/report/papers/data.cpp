#include "app/report/papers/data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <memory>
#include <numeric>

#include "app/report/light.h"
#include "app/report/subjects.h"
#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

// Returns the start of the run of `extent` voxels along an axis that has most bright voxels.
int fullestRun(const GreyVolume& volume, int axis, int extent, int bright) {
    std::vector<std::size_t> counts(static_cast<std::size_t>(volume.frame.size[axis]), 0);
    for (int k = 0; k < volume.frame.size.z; ++k)
        for (int j = 0; j < volume.frame.size.y; ++j)
            for (int i = 0; i < volume.frame.size.x; ++i)
                counts[static_cast<std::size_t>(glm::ivec3(i, j, k)[axis])] += volume.at(i, j, k) >= bright;
    int best = 0;
    std::size_t most = 0;
    for (int first = 0; first + extent <= volume.frame.size[axis]; ++first) {
        const std::size_t sum =
            std::accumulate(counts.begin() + first, counts.begin() + first + extent, std::size_t{0});
        if (sum > most) most = sum, best = first;
    }
    return best;
}

GreyVolume engineOf(const fs::path& file) {
    constexpr int kMetal = 60;  // value out of 0..255
    Progress quiet;
    const Study study = readStudy(file, {}, quiet);
    const glm::ivec3 extent = glm::min(glm::ivec3(149, 208, 110), study.grey.frame.size);
    glm::ivec3 first;
    for (int axis = 0; axis < 3; ++axis) first[axis] = fullestRun(study.grey, axis, extent[axis], kMetal);
    GreyVolume part(study.grey.frame.cropped(first, extent));
    for (int k = 0; k < extent.z; ++k)
        for (int j = 0; j < extent.y; ++j)
            for (int i = 0; i < extent.x; ++i) part.at(i, j, k) = study.grey.at(first + glm::ivec3(i, j, k));
    return part;
}

}  // namespace

PaperData::PaperData(const std::string& folder) : mFolder(folder) {
    if (!folder.empty() && !fs::is_directory(folder))
        throw Error("--data", "", "expected a folder, got \"" + folder + "\"",
                    "docs/testing.md says what lies in it");
    if (!folder.empty()) return;
    if (const char* set = std::getenv("STEREONAV_TEST_DATA")) {
        mFolder = set;
        return;
    }
    for (const char* place : {"../shared/data", "../../shared/data", "../../../../shared/data"})
        if (fs::exists(place)) {
            mFolder = place;
            return;
        }
}

fs::path PaperData::find(const char* name) const {
    if (mFolder.empty()) return {};
    const fs::path file = mFolder / name;
    std::error_code ignored;
    return fs::exists(file, ignored) ? file : fs::path();
}

PaperVolume paperVolume(const PaperData& data, const char* name, const char* title) {
    const fs::path file = data.find(name);
    if (file.empty()) return {std::string("a made block with three holes") + kStandsIn, blockWithHoles()};
    Progress quiet;
    Study study = readStudy(file, {}, quiet);
    const glm::ivec3 size = study.grey.frame.size;
    return {title + (", " + std::to_string(size.x)) + "x" + std::to_string(size.y) + "x" +
                std::to_string(size.z) + " voxels",
            std::move(study.grey)};
}

PaperEngine paperEngine(const PaperData& data) {
    const fs::path engine = data.find("ct/engine.nii.gz"), probe = data.find("probes/grace.hdr");
    if (engine.empty() || probe.empty())
        return {std::string("a made block of 72x96x56 voxels under a clear sky") + kStandsIn,
                blockWithHoles(), clearSkyLight()};
    LightSetup setup;
    setup.probe = std::make_shared<LightProbe>(readLightProbe(probe));
    setup.bounces = kReportBounces;
    return {"the engine, 149x208x110 voxels, under Grace Cathedral's probe", engineOf(engine), setup};
}

GreyVolume resizedTo(const GreyVolume& volume, const glm::ivec3& size) {
    VolumeFrame frame = volume.frame;
    const glm::dvec3 scale =
        glm::dvec3(volume.frame.size - 1) / glm::dvec3(glm::max(size - 1, glm::ivec3(1)));
    frame.spacing *= scale;
    frame.size = size;
    GreyVolume resized(frame);
    resized.scale = volume.scale;
    resized.offset = volume.offset;
    const glm::ivec3 last = volume.frame.size - 1;
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 at = glm::dvec3(i, j, k) * scale;
                const glm::ivec3 low = glm::min(glm::ivec3(at), last), high = glm::min(low + 1, last);
                const glm::dvec3 f = at - glm::dvec3(low);
                double value = 0;
                for (int n = 0; n < 8; ++n) {
                    const glm::ivec3 corner(n & 1 ? high.x : low.x, n & 2 ? high.y : low.y,
                                            n & 4 ? high.z : low.z);
                    value += (n & 1 ? f.x : 1 - f.x) * (n & 2 ? f.y : 1 - f.y) * (n & 4 ? f.z : 1 - f.z) *
                             volume.at(corner);
                }
                resized.at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
            }
    });
    return resized;
}

}  // namespace stereonav
