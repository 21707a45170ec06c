// The centreline of a real colon, against the one its publishers give (4,338 points, anus to appendix).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "colon/centreline/centreline.h"
#include "colon/centreline/centreline_probe.h"
#include "colon/study/study.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

std::filesystem::path realColon() {
    const char* place = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path data =
        place ? std::filesystem::path(place) : std::filesystem::path(STEREONAV_SOURCE_DIR) / "../shared/data";
    return data / "colon" / "gca00020";
}

Study realStudy() {
    Progress progress;
    return readStudy(realColon() / "large_intestine_mask_clean.nrrd", {}, progress);
}

// The path is given in voxels of the full image, whose voxel (56, 63, 35) is the mask's first.
std::vector<glm::dvec3> referencePath(const VolumeFrame& mask) {
    const auto json = nlohmann::json::parse(readTextFile(realColon() / "large_intestine_path.jsn"));
    std::vector<glm::dvec3> points;
    for (const auto& p : json.at("points"))
        points.push_back(
            mask.worldFromVoxel({p[0].get<double>() - 56, p[1].get<double>() - 63, p[2].get<double>() - 35}));
    return points;
}

double valueAt(const LumenField& lumen, const glm::dvec3& world) {
    const glm::dvec3 v = lumen.field.frame.voxelFromWorld(world), low = glm::floor(v), t = v - low;
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 up(n & 1, n >> 1 & 1, n >> 2);
        const glm::dvec3 w = glm::mix(1.0 - t, t, glm::dvec3(up));
        sum += w.x * w.y * w.z * lumen.field.at(glm::ivec3(low) + up);
    }
    return sum;
}

double distanceTo(const std::vector<glm::dvec3>& line, const glm::dvec3& p) {
    double least = INFINITY;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const glm::dvec3 along = line[n] - line[n - 1];
        const double t = std::clamp(glm::dot(p - line[n - 1], along) / glm::dot(along, along), 0.0, 1.0);
        least = std::min(least, glm::length(p - line[n - 1] - t * along));
    }
    return least;
}

TEST(CentrelineNightly, FollowsThePublishedPath) {
    if (!std::filesystem::exists(realColon())) GTEST_SKIP() << realColon() << " is not there";
    const Study study = realStudy();
    ASSERT_TRUE(study.isMask);
    Progress progress;
    const LumenField lumen = lumenFromMask(study.mask, {}, progress);
    ASSERT_EQ(lumen.segments.size(), 1u);
    ASSERT_EQ(lumen.segments[0].voxels, 7887976u);
    const DistanceVolume distance = distanceToOutside(lumen.lumen);
    const Stopwatch watch;
    const std::clock_t used = std::clock();
    const Centreline line = findCentreline(lumen, distance, {}, progress);
    const double elapsed = watch.elapsed_ms();
    const double processor = 1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC;
    const std::vector<glm::dvec3> reference = referencePath(study.mask.frame);
    double mean = 0, most = 0, radius = 0, narrowest = INFINITY;
    std::vector<glm::dvec3> ours;
    for (const CentrelinePoint& p : line.points) {
        const glm::ivec3 nearest(glm::round(lumen.lumen.frame.voxelFromWorld(p.position)));
        ASSERT_TRUE(lumen.lumen.frame.contains(nearest));
        EXPECT_EQ(lumen.lumen.at(nearest), 1);
        EXPECT_LT(valueAt(lumen, p.position), lumen.isovalue);
        const double away = distanceTo(reference, p.position);
        mean += away / line.points.size();
        most = std::max(most, away);
        radius += p.radius / line.points.size();
        narrowest = std::min(narrowest, p.radius);
        ours.push_back(p.position);
    }
    double meanBack = 0, mostBack = 0, referenceLength = 0;
    for (std::size_t n = 0; n < reference.size(); ++n) {
        const double away = distanceTo(ours, reference[n]);
        meanBack += away / reference.size();
        mostBack = std::max(mostBack, away);
        if (n) referenceLength += glm::length(reference[n] - reference[n - 1]);
    }
    const LumenProbe probe(lumen, distance, 1);
    double referenceRadius = 0, sharpest = 0;
    for (const glm::dvec3& p : reference) referenceRadius += probe.radius(p) / reference.size();
    for (std::size_t n = 1; n + 1 < ours.size(); ++n) {
        const glm::dvec3 a = glm::normalize(ours[n] - ours[n - 1]), b = glm::normalize(ours[n + 1] - ours[n]);
        sharpest = std::max(sharpest, std::acos(std::min(1.0, glm::dot(a, b))) * 57.29578);
    }
    std::printf("radius along the reference: mean %.1f mm; sharpest turn %.1f degrees a point\n",
                referenceRadius * 1e3, sharpest);
    std::printf(
        "centreline %.1f mm, reference %.1f mm; to the reference: mean %.2f, at most %.2f mm; "
        "back: mean %.2f, at most %.2f mm; radius: mean %.1f, least %.2f mm; %zu points, %.0f ms, %.0f ms of "
        "processor time\n",
        line.length() * 1e3, referenceLength * 1e3, mean * 1e3, most * 1e3, meanBack * 1e3, mostBack * 1e3,
        radius * 1e3, narrowest * 1e3, line.points.size(), elapsed, processor);
    EXPECT_NEAR(line.length(), 2.390, 0.05 * 2.390);
    EXPECT_LT(mean, 0.005);
    EXPECT_LT(meanBack, 0.005);
    // Rectum first: at the reference's start.
    EXPECT_LT(glm::length(line.points.front().position - reference.front()), 0.05);
    EXPECT_LT(glm::length(line.points.back().position - reference.back()), 0.05);
}

}  // namespace
}  // namespace stereonav
