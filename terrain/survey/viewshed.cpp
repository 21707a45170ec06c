#include "terrain/survey/viewshed.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/simd/simd_target.h"
#include "terrain/survey/fan_sweep.h"

namespace stereonav {
namespace {

const FanKernels& fanKernels() {
    static const FanKernels plainSet{plain::readHeights, plain::raiseLow, plain::raiseHigh,
                                     plain::tellSamples, plain::walkSamples},
        avx2Set{avx2::readHeights, avx2::raiseLow, avx2::raiseHigh, avx2::tellSamples, avx2::walkSamples},
        avx512Set{avx512::readHeights, avx512::raiseLow, avx512::raiseHigh, avx512::tellSamples,
                  avx512::walkSamples};
    return kernelsOf(SimdTarget::Auto, plainSet, avx2Set, avx512Set);
}

double checkedEye(const Heightfield& ground, const ViewshedSetting& setting) {
    const glm::dvec2 g = setting.eye;
    const bool inside = g.x >= 0 && g.y >= 0 && g.x <= ground.width() - 1 && g.y <= ground.height() - 1;
    const double height = inside ? ground.heightAt(ground.worldFromGrid(g)) : 0;
    if (!inside || !std::isfinite(height))
        throw Error("", "the eye's place",
                    inside ? "expected ground, found a hole in it" : "expected a place on the ground",
                    "choose another one");
    return height + setting.eyeHeight;
}

// Samples that are known and within reach.
long long samplesWithin(const Heightfield& ground, const ViewshedSetting& setting) {
    long long count = 0;
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i) {
            const glm::dvec2 run = (glm::dvec2(i, j) - setting.eye) * ground.spacing();
            count +=
                glm::dot(run, run) <= setting.reach * setting.reach && std::isfinite(ground.sample(i, j));
        }
    return count;
}

// Parts of a fan: enough for many threads, and columns in each long enough to be worth their beginning.
int partsOf(const Heightfield& ground) {
    constexpr int kRowsEach = 128, kMostParts = 16;
    return std::clamp(std::max(ground.width(), ground.height()) / kRowsEach, 1, kMostParts);
}

}  // namespace

Viewshed viewshedOf(const Heightfield& ground, const ViewshedSetting& setting, Progress& progress) {
    const double eye = checkedEye(ground, setting);
    const HeightPyramid none;  // for grazing() alone, which needs none
    const double grazing =
        SightLines(ground, none, setting.fall).grazing(setting.eye, eye, setting.targetHeight);
    const HoleTiles holes(ground);
    const SingleLines lines(ground, setting.fall);
    Viewshed result;
    result.seen.resize(ground.width(), ground.height());
    const FanTask task{ground,
                       holes,
                       lines,
                       fanKernels(),
                       glm::dvec3(setting.eye, eye),
                       setting.fall,
                       setting.targetHeight,
                       setting.reach,
                       grazing,
                       result.seen};
    const int parts = partsOf(ground);
    std::vector<FanCounts> counts(static_cast<std::size_t>(4) * parts);
    ProgressSteps fans(progress, counts.size(), "looking around");
    parallelFor(4 * parts, [&](int k) {
        const int fan = k % 4;
        counts[static_cast<std::size_t>(k)] = FanSweep(task, fan / 2, fan % 2 ? -1 : 1, k / 4, parts).run();
        fans.done();
    });
    result.samples = static_cast<long long>(ground.width()) * ground.height();
    for (const FanCounts& part : counts) {
        result.visible += part.visible, result.samples -= part.unknown;
        result.walkedNear += part.near, result.walkedAll += part.all, result.walkedAlone += part.alone;
    }
    if (setting.reach > 0) result.samples = samplesWithin(ground, setting);
    // The sample on which the eye stands is in no fan.
    if (setting.eye == glm::floor(setting.eye)) {
        result.seen.row(static_cast<int>(setting.eye.y))[static_cast<int>(setting.eye.x)] =
            static_cast<std::uint8_t>(Seen::Visible);
        ++result.visible;
    }
    return result;
}

}  // namespace stereonav
