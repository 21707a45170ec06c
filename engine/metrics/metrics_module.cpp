// The metrics that need OpenCV, handed on to their module.
#include "engine/metrics/metrics_module.h"

#include "engine/base/module.h"

namespace stereonav {
namespace {

const MetricsFunctions& opencv() {
    static const auto& functions =
        moduleFunctions<MetricsFunctions>("metrics", "to measure differences of pictures");
    return functions;
}

}  // namespace

ImageDifference differenceOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                             const Plane<std::uint8_t>& edgeMask) {
    return opencv().differenceOf(truth, image, edgeMask);
}

double psnrOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    return opencv().psnrOf(truth, image);
}

Plane<std::uint8_t> edgeMask(const Plane<std::uint8_t>& holeMask, const Plane<float>& viewDepth,
                             double parallaxScale, int radius) {
    return opencv().edgeMask(holeMask, viewDepth, parallaxScale, radius);
}

Plane<PackedColor> differenceTimes(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                                   int factor) {
    return opencv().differenceTimes(truth, image, factor);
}

Plane<PackedColor> chartPicture(const ChartDrawing& drawing) {
    return opencv().chartPicture(drawing);
}

}  // namespace stereonav
