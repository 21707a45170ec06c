// Edges of a colon's folds are even lines: a slanted one, that crosses a column of pixels every seven rows,
// is no darker in one row than in another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/sampling/edge_rays.h"
#include "engine/stereo/right_eye.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

constexpr double kFoldSlant = 1.0 / 7;  // columns a row

// A fold 6 mm thick that hides what is to the right, 25 mm before an eye at the origin, and a wall 15 mm
// behind it; grey values as CT's.
VolumeScene slantedFold() {
    VolumeScene scene;
    VolumeFrame frame;
    frame.size = {60, 84, 60};
    frame.spacing = glm::dvec3(0.0006);
    frame.origin = {-0.018, -0.003, -0.018};
    scene.field = GreyVolume(frame);
    const glm::dvec3 along = glm::normalize(glm::dvec3(-kFoldSlant, 0, 1));
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const glm::dvec3 p = frame.worldFromVoxel({i, j, k}) - glm::dvec3(0, 0.025, 0);
                const glm::dvec3 across = p - glm::dot(p, along) * along;
                const glm::dvec3 beside(std::min(across.x, 0.0), across.y, 0);
                const double fold = 0.003 - glm::length(beside), wall = p.y - 0.015;
                const double voxels = std::max(fold, wall) / 0.0006;
                scene.field.at(i, j, k) =
                    static_cast<std::int16_t>(std::lround(-480 + 520 * std::tanh(voxels)));
            }
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = -480;
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.surface = {0.78f, 0.33f, 0.25f};
    scene.look.ambient = 0.10f;
    scene.look.diffuse = 1.05f;
    scene.look.specular = 0;
    scene.look.falloff = 0;
    return scene;
}

// The least and the largest of rows' darkest levels, of 255.
struct DarkestLevels {
    double least = 255, most = 0;
};

DarkestLevels darkestOf(const EyeImage& image) {
    DarkestLevels levels;
    for (int y = 20; y < image.height() - 20; ++y) {
        double darkest = 255;
        for (int x = 0; x < image.width(); ++x)
            darkest = std::min(darkest, (image.color.at(x, y) & 1023u) * (255.0 / 1023));
        levels.least = std::min(levels.least, darkest);
        levels.most = std::max(levels.most, darkest);
    }
    return levels;
}

// Both eyes as they are shown: the right one warped, more rays at edges.
struct FoldEyes {
    EyeImage left, right;
};
FoldEyes foldEyes(const VolumeScene& scene, const VolumeCasting& casting) {
    Lens lens;
    lens.width = 160;
    lens.height = 120;
    lens.verticalFov = 2 * std::atan(120.0 / 720);  // pixels as those of 720 rows and 90 degrees
    lens.nearDepth = 0.001;
    const StereoViews views = makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), lens, {0.0008, 0.025});
    const VolumeRenderer renderer(scene, casting);
    FoldEyes eyes;
    eyes.left.resize(lens.width, lens.height, renderer.viewDependence());
    renderEye(renderer, views.left, eyes.left);
    RightEye rightEye;
    rightEye.render(renderer, views, eyes.left, {}, eyes.right);
    EdgeRays edges;
    EdgeSetting setting;
    setting.rays = 4;
    edges.smooth(renderer, views.left, setting, eyes.left);
    edges.smooth(renderer, views.right, setting, eyes.right);
    return eyes;
}

TEST(EdgeLines, ASlantedFoldIsAsDarkInEveryRow) {
    const VolumeScene scene = slantedFold();
    for (const SimdTarget target : simdTargets()) {
        const FoldEyes matt = foldEyes(scene, {target});
        VolumeCasting casting;
        casting.target = target;
        casting.leastCosine = 0.3f;
        const FoldEyes even = foldEyes(scene, casting);
        for (const bool right : {false, true}) {
            const DarkestLevels before = darkestOf(right ? matt.right : matt.left);
            const DarkestLevels after = darkestOf(right ? even.right : even.left);
            std::printf("%s, %s eye: darkest of a row %.1f to %.1f levels; lit to the edge %.1f to %.1f\n",
                        std::string(nameOf(target)).c_str(), right ? "right" : "left", before.least,
                        before.most, after.least, after.most);
            EXPECT_GT(before.most - before.least, 20) << "what is compared is no easy case";
            EXPECT_LT(after.most - after.least, 8);
        }
    }
}

}  // namespace
}  // namespace stereonav
