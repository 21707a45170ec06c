// Every function of light that takes a Progress tells all of it; bakes: bake_job_test.cpp.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "engine/light/occlusion/occlusion.h"
#include "engine/light/occlusion/occlusion_modulation.h"
#include "engine/light/occlusion/occlusion_rays.h"
#include "engine/light/paths/pixel_path.h"
#include "engine/light/transfer/bake_texels.h"
#include "engine/volume/surface_cells.h"
#include "tests/light/light_scenes.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

using test::expectWholeProgress;

GreyVolume ballToLight() {
    return test::ballVolume(24, glm::dvec3(12), 7);
}

TEST(LightProgress, IsWholeOfOpenness) {
    const GreyVolume volume = ballToLight();
    GreyVolume even = volume.share();
    even.scale = 0;
    for (const OcclusionMethod method : {OcclusionMethod::Gaussian, OcclusionMethod::Reconstructed,
                                         OcclusionMethod::DrawnIn, OcclusionMethod::Chebyshev})
        for (const GreyVolume* const of : {&volume, &std::as_const(even)})
            expectWholeProgress("openness", 0, [&](Progress& progress) {
                OcclusionEstimate estimate;
                estimate.method = method;
                estimateOpenness(*of, estimate, glm::ivec3(3), progress);
            });
    // Rows of more than a band.
    const GreyVolume large(VolumeFrame{{300, 1200, 12}, glm::dvec3(1e-3)});
    expectWholeProgress("openness in bands", 1,
                        [&](Progress& progress) { estimateOpenness(large, {}, glm::ivec3(1), progress); });
    for (const DirectionMethod method : {DirectionMethod::Vicinity, DirectionMethod::Obscurance})
        expectWholeProgress("openness along directions", 0, [&](Progress& progress) {
            opennessByDirections(volume, method, 2e-3, progress);
        });
}

TEST(LightProgress, IsWholeOfModulations) {
    const GreyVolume volume = ballToLight();
    const TransferFunction transfer({{0, glm::vec3(1.0f), 0.0}, {1, glm::vec3(1.0f), 0.5}}, 0.001, "test");
    expectWholeProgress("modulation by variance", 0, [&](Progress& progress) {
        varianceModulation(volume, glm::ivec3(2), 100, progress);
    });
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient})
        for (const bool given : {false, true})
            expectWholeProgress("modulation", 0, [&](Progress& progress) {
                ModulationSetting setting{by, glm::ivec3(2), {}, {}};
                if (given) setting.sigma = 0.05;
                opacityModulation(volume, setting, transfer, progress);
            });
}

TEST(LightProgress, IsWholeOfChosenTexels) {
    const GreyVolume volume = ballToLight();
    for (const bool full : {false, true})
        expectWholeProgress("chosen texels", 2, [&](Progress& progress) {
            TexelChoice choice;
            choice.full = full;
            wantedBricks(volume, volume.frame, choice, progress);
        });
}

TEST(LightProgress, IsWholeOfPathsFromPixels) {
    VolumeScene scene;
    scene.field = ballToLight();
    Progress quiet;
    scene.cells = findSurfaceCells(scene.field, {}, quiet);
    LightSetup setup;
    setup.sky = glm::vec3(1);
    Plane<float> depths(9, 7);
    std::fill_n(depths.row(0), 9 * 7, 0.01f);
    EyeView view;
    view.width = 9, view.height = 7;
    const PixelPaths paths(scene, setup, {});
    expectWholeProgress("paths", 6, [&](Progress& progress) {
        Plane<TexelSum> sums;
        paths.add(view, depths, 0, 1, sums, progress);
    });
}

}  // namespace
}  // namespace stereonav
