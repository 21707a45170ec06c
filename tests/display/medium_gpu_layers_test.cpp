// Layers over height fields in GLSL against the reference model (plain_sweep.h): noise, holes, colours of
// their own.
#include "tests/display/medium_gpu_subject.h"

namespace stereonav::gpu_test {
namespace {

using MediumGpuLayers = MediumGpuTest;

// Hills and a sheet of mist above them; a sample is not known.
std::vector<HeightLayer> hillsUnderMist() {
    std::vector<HeightLayer> layers(2);
    for (int n = 0; n < 2; ++n) {
        HeightLayer& layer = layers[n];
        layer.spacing = n == 0 ? 0.08 : 0.11;
        layer.originX = kMiddle.x - 1;
        layer.originY = kMiddle.y - 0.9;
        Plane<float>& heights = layer.levels.emplace_back(25, 19 + n);
        for (int y = 0; y < heights.height(); ++y)
            for (int x = 0; x < heights.width(); ++x)
                heights.at(x, y) =
                    static_cast<float>(kMiddle.z + (n == 0 ? 0.2 * std::sin(0.6 * x) * std::cos(0.5 * y)
                                                           : 0.35 + 0.05 * std::sin(0.9 * x + y)));
        layer.below = n == 0 ? 0.3 : 0.1;
        layer.above = 0.1;
        layer.taper = n == 0 ? 0 : 0.07;
        std::vector<MediumPoint> points(2);
        points[0].value = kMiddle.z - 1;
        points[0].material = {
            {0.3f, 0.6f, 0.2f}, n == 0 ? 0.95 : 0.2, {0.5f, 0.6f, 0.7f}, n == 0 ? 0.8 : 0.0, {}};
        points[1] = points[0];
        points[1].value = kMiddle.z + 1;
        points[1].material.color = {0.9f, 0.8f, 0.7f};
        layer.table = makeMediumTable(MediumTransfer(points, 0.2, "test"), kMiddle.z - 1, kMiddle.z + 1);
        if (n == 0) heights.at(3, 4) = std::nanf("");
        makeMipLevels(layer);
    }
    return layers;
}

TEST_F(MediumGpuLayers, LayersOverHeightFields) {
    const glm::dvec3 eye = kMiddle + glm::dvec3(0.3, -1.6, 1.1);
    for (const bool noisy : {false, true}) {
        Subject subject(Medium(hillsUnderMist(), noisy ? twoScales() : Perturbation{}));
        for (const glm::dvec3& direction : {kWithView, kAgainstView})
            // Wide pixels: coarse mip levels are read.
            expectAsByTheBook(subject, lookOf(MediumModel::Indirect, direction),
                              {viewFrom(eye, kMiddle, 12, 10)}, smallSetting(), 0.5);
    }
}

// One layer of two has colours of its own, finer than its samples.
TEST_F(MediumGpuLayers, LayersWithColoursOfTheirOwn) {
    std::vector<HeightLayer> layers = hillsUnderMist();
    Plane<PackedColor> picture(61, 47);
    for (int y = 0; y < 47; ++y)
        for (int x = 0; x < 61; ++x)
            picture.at(x, y) = packColor({0.5 + 0.5 * std::sin(0.3 * x), 0.5 + 0.5 * std::cos(0.4 * y), 0.3});
    layers[0].color = std::make_shared<ColorTexture>(picture, glm::dvec2(0), glm::dvec2(0.4, 0.4));
    layers[0].colorSpacing = glm::dvec2(0.08);
    Subject subject{Medium(layers)}, plain{Medium(hillsUnderMist())};
    const glm::dvec3 eye = kMiddle + glm::dvec3(0.3, -1.6, 1.1);
    const std::vector<EyeView> eyes{viewFrom(eye, kMiddle, 12, 10)};
    for (const MediumModel model : {MediumModel::Emission, MediumModel::Indirect})
        for (const glm::dvec3& direction : {kWithView, kAgainstView}) {
            const MediumLook look = lookOf(model, direction);
            expectAsByTheBook(subject, look, eyes, smallSetting());
            std::vector<MediumPicture> with(1), without(1);
            subject.gpu.render(look, smallSetting(), eyes, eyes[0].head, 0, with);
            plain.gpu.render(look, smallSetting(), eyes, eyes[0].head, 0, without);
            EXPECT_GT(differenceOf(with[0], without[0]).worst, 0.01);
        }
}

}  // namespace
}  // namespace stereonav::gpu_test
