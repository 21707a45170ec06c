// Occlusion of real studies (skipped where the data is absent): the same bytes from every thread count and
// instruction set, whole boxes at random voxels, and nearer to ray-traced obscurance than Chebyshev's bound.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/sanitizers.h"
#include "tests/bench/occlusion_errors.h"
#include "tests/light/occlusion_brute.h"

namespace stereonav {
namespace {

constexpr std::size_t kTexels = kAddressSanitizer || kThreadSanitizer ? 60 : 600;

// Returns an empty volume where the data is absent.
GreyVolume readReal(const char* name) {
    const char* folder = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path file =
        std::filesystem::path(folder ? folder : STEREONAV_SOURCE_DIR "/../shared/data") / name;
    if (!std::filesystem::exists(file)) return {};
    Progress progress;
    return readStudy(file, {}, progress).grey;
}

OpennessVolume estimateReal(const GreyVolume& volume, OcclusionMethod method, const glm::ivec3& radius,
                            SimdTarget target = SimdTarget::Auto) {
    Progress progress;
    return estimateOpenness(volume, method, radius, progress, target);
}

bool same(const OpennessVolume& a, const OpennessVolume& b) {
    return std::equal(a.values.data(), a.values.data() + a.values.size(), b.values.data());
}

TEST(OcclusionReal, SameBytesFromEveryThreadCountAndInstructionSet) {
    const GreyVolume trunk = readReal("ct/trunk_ct_3mm.nii.gz");
    if (trunk.empty()) GTEST_SKIP() << "no ct/trunk_ct_3mm.nii.gz";
    const int threads = threadCount();
    for (const OcclusionMethod method :
         {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn, OcclusionMethod::Gaussian}) {
        const OpennessVolume first = estimateReal(trunk, method, glm::ivec3(9), SimdTarget::Plain);
        for (int n = 1; n <= 4; ++n) {
            setThreadCount(n);
            EXPECT_TRUE(same(first, estimateReal(trunk, method, glm::ivec3(9)))) << n;
        }
        setThreadCount(threads);
        for (const SimdTarget target : simdTargets())
            EXPECT_TRUE(same(first, estimateReal(trunk, method, glm::ivec3(9), target)));
    }
}

TEST(OcclusionReal, IsWhatWholeBoxesSay) {
    const GreyVolume trunk = readReal("ct/trunk_ct_3mm.nii.gz");
    if (trunk.empty()) GTEST_SKIP() << "no ct/trunk_ct_3mm.nii.gz";
    std::mt19937 engine(5);
    for (const int radius : {1, 5, 24}) {
        for (const OcclusionMethod method : test::kOcclusionMethods) {
            const OpennessVolume openness = estimateReal(trunk, method, glm::ivec3(radius));
            for (int n = 0; n < 60; ++n) {
                const glm::ivec3 size = trunk.frame.size;
                const auto below = [&](int count) {
                    return static_cast<int>(engine() % static_cast<unsigned>(count));
                };
                const glm::ivec3 voxel(below(size.x), below(size.y), below(size.z));
                const double truth =
                    test::opennessOf(test::boxAt(trunk, voxel, glm::ivec3(radius)), trunk.at(voxel), method);
                ASSERT_LE(test::bytesAway(openness.at(voxel), truth), 0.54) << radius;
            }
        }
    }
}

struct Accuracy {
    double error, rank;
};

void expectBetterThanChebyshev(const GreyVolume& volume, double isovalue) {
    const double metres =
        5 * std::min({volume.frame.spacing.x, volume.frame.spacing.y, volume.frame.spacing.z});
    const std::vector<glm::ivec3> texels = bench::surfaceTexels(volume, isovalue, kTexels);
    ASSERT_EQ(texels.size(), kTexels);
    bench::Numbers truth(kTexels);
    parallelFor(static_cast<int>(kTexels), [&](int n) {
        const auto i = static_cast<std::size_t>(n);
        truth[i] = traceOpenness(volume, texels[i], metres, 64).obscurance;
    });
    const auto accuracy = [&](OcclusionMethod method) {
        const OpennessVolume openness = estimateReal(volume, method, occlusionRadius(volume.frame, metres));
        bench::Numbers values;
        for (const glm::ivec3& texel : texels) values.push_back(openness.at(texel) / 255.0);
        return Accuracy{bench::rootMeanSquare(values, 1, truth), bench::rankCorrelation(values, truth)};
    };
    const Accuracy bound = accuracy(OcclusionMethod::Chebyshev);
    for (const OcclusionMethod method :
         {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn, OcclusionMethod::Gaussian}) {
        const Accuracy ours = accuracy(method);
        EXPECT_LT(ours.error, 0.7 * bound.error) << static_cast<int>(method);
        EXPECT_GT(ours.rank, kTexels < 600 ? 0.2 : bound.rank) << static_cast<int>(method);
    }
}

TEST(OcclusionReal, HeadIsNearerToTheTruthThanTheBound) {
    const GreyVolume head = readReal("ct/headsq/quarter.nhdr");
    if (head.empty()) GTEST_SKIP() << "no ct/headsq";
    expectBetterThanChebyshev(head, 500);
}

TEST(OcclusionReal, BonsaiIsNearerToTheTruthThanTheBound) {
    if (kAddressSanitizer || kThreadSanitizer) GTEST_SKIP() << "under sanitizers the head alone";
    const GreyVolume bonsai = readReal("ct/bonsai.nii.gz");
    if (bonsai.empty()) GTEST_SKIP() << "no ct/bonsai.nii.gz";
    expectBetterThanChebyshev(bonsai, 40);
}

}  // namespace
}  // namespace stereonav
