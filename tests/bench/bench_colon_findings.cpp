// How well polyps of generated colons are measured, over many seeds:
//   bench_colon_findings [SEEDS [LARGEST_SIDE]]
// One row a polyp, then what was missed, how many lie within 1 mm or 10 %, and how far values of the CT are
// from the 40 HU that flesh has there. Not a medical device.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "colon/instruments/polyp.h"
#include "colon/instruments/polyp_values.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/stopwatch.h"

namespace {

using namespace stereonav;

struct Count {
    int all = 0, right = 0, missed = 0;
    double error = 0;
    int told = 0;  // values of the CT
    double valueError = 0, worstValue = 0;
};

constexpr double kFlesh = 40;  // HU, of generated colons

std::string valuesText(const ColonScene& colon, const WallMesh& wall, const MeasuredPolyp& polyp,
                       const std::optional<double>& blur, Count& count) {
    const auto values = blur ? valuesInside(colon.study, wall, polyp, *blur) : std::nullopt;
    if (!values) return "";
    const double error = std::abs(values->mean - kFlesh);
    ++count.told, count.valueError += error;
    count.worstValue = std::max(count.worstValue, error);
    return fmt::format("{:.1f} +- {:.1f} HU of {} ", values->mean, values->sigma, values->voxels);
}

void measure(std::uint64_t seed, int side, Count& count) {
    Progress progress;
    ColonOptions options;
    options.builtIn.seed = seed;
    options.keepsStudy = true;
    if (side < 512) options.builtIn.size = {side, side, side * 411 / 512};
    const ColonScene colon = loadColon(options, progress);
    const WallMesh wall = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, progress);
    const PolypSetting setting = polypSettingOf(colon.volume.field.frame);
    const WallNeighbours neighbours = neighboursOf(wall);
    const std::optional<double> blur = blurAcrossWall(colon.study, wall);
    fmt::print("blur across the wall {:.2f} mm\n", 1e3 * blur.value_or(0));
    for (const Polyp& truth : colon.polyps) {
        std::string why;
        const auto found = polypAt(wall, neighbours, truth.position, setting, why);
        const double wanted = 1e3 * truth.diameter, got = found ? 1e3 * found->widest.length : 0;
        const bool right = found && std::abs(got - wanted) <= std::max(1.0, 0.1 * wanted);
        ++count.all, count.right += right, count.missed += !found;
        if (found) count.error += std::abs(got - wanted);
        const char* shape = truth.shape == PolypShape::Flat           ? "flat"
                            : truth.shape == PolypShape::Pedunculated ? "pedunculated"
                                                                      : "sessile";
        const std::string told = found ? valuesText(colon, wall, *found, blur, count) : "";
        fmt::print("{:3} {:13} {:5.1f} mm {:6.2f} mm  slice {:6.2f} mm  {:7.1f} mm^3 {:6.1f} mm^2 {}{}{}\n",
                   seed, shape, wanted, got, found ? 1e3 * found->widestInSlice.length : 0,
                   found ? 1e9 * found->volume : 0, found ? 1e6 * found->area : 0, told, right ? "" : "OUT ",
                   why);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 10, side = argc > 2 ? std::atoi(argv[2]) : 512;
    Count count;
    const Stopwatch watch;
    for (int seed = 1; seed <= seeds; ++seed) measure(static_cast<std::uint64_t>(seed), side, count);
    const int found = count.all - count.missed;
    fmt::print("{} polyps of {} colons: {} within 1 mm or 10 %, {} missed, mean error {:.2f} mm; {:.1f} s\n",
               count.all, seeds, count.right, count.missed, found ? count.error / found : 0,
               watch.elapsed_ms() / 1000);
    fmt::print("values of {}: {:.1f} HU off on average, {:.1f} at most\n", count.told,
               count.told ? count.valueError / count.told : 0, count.worstValue);
    return 0;
}
