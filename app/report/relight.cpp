// The report's chart of transfer under a turning sky: the cost of multiplying every texel with it, by order.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/light.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/transfer_volume.h"

namespace stereonav {
namespace {

// Returns the first bands of every vector.
std::vector<float> firstBands(const std::vector<float>& means, int from, int order) {
    const std::size_t all = static_cast<std::size_t>(harmonicsCount(from)),
                      some = static_cast<std::size_t>(harmonicsCount(order));
    std::vector<float> bands;
    for (std::size_t n = 0; n + all <= means.size(); n += all)
        bands.insert(bands.end(), &means[n], &means[n] + some);
    return bands;
}

// Returns numbers for `wanted` texels, by repeating the given ones.
std::vector<float> repeated(const std::vector<float>& numbers, std::size_t wanted) {
    std::vector<float> more;
    more.reserve(wanted);
    while (more.size() < wanted && !numbers.empty())
        more.insert(
            more.end(), numbers.begin(),
            numbers.begin() + static_cast<std::ptrdiff_t>(std::min(numbers.size(), wanted - more.size())));
    return more;
}

TransferVolume transferOf(const LightSubject& subject, const std::vector<TexelBrick>& bricks,
                          const std::vector<float>& means, int order) {
    const std::size_t numbers = static_cast<std::size_t>(harmonicsCount(order));
    TransferVolume volume(subject.volume.frame, order, 1, bricks);
    const std::vector<float> all = repeated(means, volume.texels() * numbers);
    std::size_t at = 0;
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        const std::size_t count = static_cast<std::size_t>(countTexels(bricks[n].wanted)) * numbers;
        volume.setBrick(n, std::span(all).subspan(at, count));
        at += count;
    }
    return volume;
}

// Measures transfer as the program stores and relights it: half floats, one pass over all bricks of the
// surface.
WayPoint relightPoint(ReportRun& run, const LightSubject& subject, const std::vector<float>& means,
                      int order) {
    const std::vector<glm::vec3> sky = subject.setup.probe->project(order);
    const TransferVolume whole = transferOf(subject, subject.allBricks, means, order);
    IlluminationVolume to(subject.volume.frame);
    std::vector<double> ms;
    for (int n = 0; n < run.pick(15, 50); ++n) {
        const Stopwatch watch;
        whole.relightAll(sky, to);
        ms.push_back(watch.elapsed_ms() * 1000 / static_cast<double>(whole.texels()));
    }
    transferOf(subject, subject.bricks, means, order).relightAll(sky, to);
    std::vector<double> light;
    for (const glm::ivec3& t : subject.texels)
        light.push_back(luminance(glm::dvec3(texelLight(to.texels[to.layout.index(t.x, t.y, t.z)]))));
    light = subject.onlyLit(light);
    return {{fmt::format("order {}", order), spreadOf(ms), 100 * relativeRms(light, subject.truth),
             order == kDefaultOrder},
            "half floats, as the program keeps them",
            100 * relativeWorst(light, subject.truth),
            {{"bytes a texel", 2.0 * harmonicsCount(order)}}};
}

}  // namespace

WayChart relightChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = lightChart(run, subject, "light/relight", "Turning the sky: order");
    chart.text +=
        " Time to dot every texel with a turned sky; error against the path-traced light. Bytes a texel are "
        "in the table.";
    chart.why = "Order 5 is the default of bake.";
    const int samples = run.pick(512, 2048);
    run.tell("light, transfer");
    const MeasuredTransfer t =
        bakeTransfer(subject, subject.lighter(false, kFirstSeed), kMaxHarmonicsOrder, samples);
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order)
        chart.points.push_back(
            relightPoint(run, subject, firstBands(t.means, kMaxHarmonicsOrder, order), order));
    return chart;
}

}  // namespace stereonav
