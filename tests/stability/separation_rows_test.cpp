// Eyes from no distance at all to ten times that of the nearest thing apart: the warped right eye of a
// terrain and of a lumen against the full cast.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <memory>

#include "engine/stereo/right_eye.h"
#include "engine/volume/plain_volume_caster.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

struct OpaqueStage {
    std::shared_ptr<void> scene;
    std::unique_ptr<EyeRenderer> renderer;
    Pose head;
    // Depth seen at continuous coordinates, in double precision.
    std::function<double(const EyeView& view, double x, double y)> castPlainly;
    double nearest;  // metres, of what the head sees
};

Lens lensOf(double nearDepth) {
    return {160, 24, 0.25, 1.0, nearDepth};
}

void findNearest(OpaqueStage& stage, double nearDepth) {
    const EyeImage image = castPicture(*stage.renderer, makeEyeView(stage.head, lensOf(nearDepth)));
    stage.nearest = HUGE_VAL;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            stage.nearest = std::min(stage.nearest, double(image.viewDepth.at(x, y)));
}

// Hills, seen from above their tops with a little sky.
OpaqueStage terrainStage() {
    OpaqueStage stage;
    auto scene = std::make_shared<TerrainScene>(makeScene(makeGround("smooth", 129, 129, 1)));
    stage.renderer = std::make_unique<TerrainRenderer>(*scene);
    stage.head = poseFromAngles({100, -900, scene->ground.maxHeight() + 25.0}, 0.3, -0.35, 0);
    stage.castPlainly = [scene](const EyeView& view, double x, double y) {
        return castPlain(scene->ground, view.eye, view.rayDirection(x, y), view.nearDepth).t;
    };
    stage.scene = scene;
    findNearest(stage, 0.1);
    return stage;
}

// A cavity with a polyp before the eyes: ten times the nearest distance still fits into it.
OpaqueStage colonStage() {
    OpaqueStage stage;
    const glm::dvec3 middle(0.028, 0.028, 0.028);
    const auto wall = [=](const glm::dvec3& p) {
        const double cavity = glm::length(p - middle) - 0.026;
        return std::max(cavity, 0.0025 - glm::length(p - middle - glm::dvec3(0.0008, 0.006, 0)));
    };
    auto scene = std::make_shared<VolumeScene>(
        surfaceScene(walledVolume(frameOf(glm::ivec3(71), glm::dvec3(0.0008)), wall, 3e5), -480));
    stage.renderer = std::make_unique<VolumeRenderer>(*scene);
    stage.head = poseFromAngles(middle, 0, 0, 0);
    stage.castPlainly = [scene](const EyeView& view, double x, double y) {
        const PlainRay ray{view.eye, view.rayDirection(x, y), view.nearDepth};
        return castPlainVolume(scene->field, scene->cells.isovalue, ray).t;
    };
    stage.scene = scene;
    findNearest(stage, 1e-4);
    return stage;
}

const OpaqueStage& stageOf(bool terrain) {
    static const OpaqueStage kTerrain = terrainStage(), kColon = colonStage();
    return terrain ? kTerrain : kColon;
}

StereoViews viewsOf(const OpaqueStage& stage, double factor) {
    return makeStereoViews(stage.head, lensOf(0.2 * stage.nearest),
                           {factor * stage.nearest, 4 * std::max(1.0, factor) * stage.nearest});
}

struct Range {
    double least = HUGE_VAL, most = 0;
    void add(double depth) {
        least = std::min(least, depth);
        most = std::max(most, depth);
    }
    // A two-hundredth for the slope of what is just behind an edge.
    bool holds(double depth) const { return depth >= least * 0.995 && depth <= most * 1.005; }
};

// Returns what double precision, one ray at a time, sees within `reach` pixels of a place of the right
// picture.
Range seenAround(const OpaqueStage& stage, const EyeView& view, double x, double y, double reach) {
    Range range;
    for (int k = -2; k <= 2; ++k) range.add(stage.castPlainly(view, x + reach * k / 2, y));
    return range;
}

// A warped pixel has the depth of a left pixel that comes to lie beside it (or where splats are two pixels
// wide, up to two away), or one between it and the next. Those are seen there, but for what the left eye has
// no sample of: the last pixel before an edge.
bool isRightlyShown(const OpaqueStage& stage, const StereoViews& views, const EyeImage& left, int x, int y,
                    float depth) {
    const float* row = left.viewDepth.row(y);
    const auto seen = [&](int i) {
        const double column = views.rightColumn(i + 0.5, row[i]);
        return std::abs(column - (x + 0.5)) <= 2 &&
               seenAround(stage, views.right, column, y + 0.5, 1).holds(row[i]);
    };
    for (int i = 0; i < left.width(); ++i) {
        const bool last = i + 1 == left.width();
        const float low = last ? row[i] : std::min(row[i], row[i + 1]);
        const float high = last ? row[i] : std::max(row[i], row[i + 1]);
        if (row[i] == depth && seen(i)) return true;
        if (!last && depth >= low && depth <= high && seen(i) && seen(i + 1)) return true;
    }
    return false;
}

// Right pixels of a row that the left eye's depths, by the rule of ResampleRow, leave open at most: spans
// between survivors that no link bridges, with the link before each and a pixel at either end; the ends.
double openPixels(const StereoViews& views, const EyeImage& left, const WarpSetting& setting, int y) {
    const int width = left.width();
    std::vector<double> columns;
    std::vector<int> of;
    double leftmost = HUGE_VAL;
    for (int i = width - 1; i >= 0; --i) {
        const double column = views.rightColumn(i + 0.5, left.viewDepth.at(i, y));
        if (!(column < leftmost)) continue;
        leftmost = column;
        columns.insert(columns.begin(), column);
        of.insert(of.begin(), i);
    }
    const auto inside = [&](double c) { return std::clamp<double>(c, 0, width); };
    double open = 0;
    const auto add = [&](double from, double to) {
        open += inside(to + 1) - inside(from - setting.maxStretch - 1);
    };
    add(-HUGE_VAL, columns.front());
    for (std::size_t k = 1; k < of.size(); ++k) {
        const double gap = columns[k] - columns[k - 1];
        const bool linked =
            of[k] == of[k - 1] + 1 && gap > setting.minStretch + 1e-3 && gap < setting.maxStretch - 1e-3;
        if (!linked) add(columns[k - 1], columns[k]);
    }
    add(columns.back(), HUGE_VAL);
    return std::min<double>(open, width);
}

// Where region V may lie: things at the near distance that are outside the left eye's window.
int firstOfRegionV(const StereoViews& views) {
    const EyeView& view = views.right;
    const double first = view.width + views.shiftAtInfinity - views.parallaxScale / view.nearDepth;
    return static_cast<int>(std::clamp<double>(std::floor(first), 0, view.width));
}

class SeparationRow : public testing::TestWithParam<std::tuple<bool, double>> {
protected:
    bool terrain() const { return std::get<0>(GetParam()); }
    double factor() const { return std::get<1>(GetParam()); }
    std::string id(const std::string& what) const {
        return "separation/" + what + (terrain() ? "/terrain/" : "/colon/") + shortNumber(factor());
    }
    std::string words() const {
        return std::string(terrain() ? "a terrain" : "a lumen") + ", eyes " + shortNumber(factor()) +
               " times the nearest distance apart";
    }
};

TEST_P(SeparationRow, EveryPixelIsSound) {
    StabilityRow row(id("sound"), words() + ", all methods", "pixels of no depth or of a depth that is none",
                     0, "pixels");
    row.count(0);
    const OpaqueStage& stage = stageOf(terrain());
    const StereoViews views = viewsOf(stage, factor());
    const EyeImage left = castPicture(*stage.renderer, views.left);
    for (const NamedMethod& named : kRightEyeMethods) {
        WarpSetting setting;
        setting.method = named.method;
        RightEye eye;
        EyeImage right;
        eye.render(*stage.renderer, views, left, setting, right);
        const bool leavesHoles =
            named.method == RightEyeMethod::McMillan || named.method == RightEyeMethod::NoFill;
        for (int y = 0; y < right.height(); ++y)
            for (int x = 0; x < right.width(); ++x) {
                const float depth = right.viewDepth.at(x, y);
                const bool hole = leavesHoles && eye.holeMask().at(x, y) && depth == 0;
                row.count(!hole && !(depth >= views.right.nearDepth * (1 - 1e-6)));
            }
    }
}

TEST_P(SeparationRow, WhatIsShownIsThere) {
    const OpaqueStage& stage = stageOf(terrain());
    const StereoViews views = viewsOf(stage, factor());
    const EyeImage left = castPicture(*stage.renderer, views.left);
    for (const RightEyeMethod method :
         {RightEyeMethod::Paper, RightEyeMethod::Linear, RightEyeMethod::Cubic}) {
        StabilityRow row(id("shown/" + std::string(nameOf(method))),
                         words() + ", " + std::string(nameOf(method)),
                         "pixels of a depth that is not seen there", 0, "pixels");
        row.count(0);
        WarpSetting setting;
        setting.method = method;
        RightEye eye;
        EyeImage picture;
        eye.render(*stage.renderer, views, left, setting, picture);
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x) {
                const float depth = picture.viewDepth.at(x, y);
                // Cast as in full, but for grazing rays: holes, and single pixels between them.
                const bool right =
                    seenAround(stage, views.right, x + 0.5, y + 0.5, 1e-3).holds(depth) ||
                    (!eye.holeMask().at(x, y) && isRightlyShown(stage, views, left, x, y, depth));
                row.count(!right);
            }
        if (factor() == 0) row.count(static_cast<double>(differentPixels(left, picture)));
    }
}

TEST_P(SeparationRow, HolesAreWhatDepthsLeaveOpen) {
    const OpaqueStage& stage = stageOf(terrain());
    const StereoViews views = viewsOf(stage, factor());
    const EyeImage left = castPicture(*stage.renderer, views.left);
    WarpSetting setting;
    double open = 0;
    for (int y = 0; y < left.height(); ++y)
        open += std::min<double>(left.width(),
                                 openPixels(views, left, setting, y) + left.width() - firstOfRegionV(views));
    StabilityRow row(id("holes"), words(), "holes of the default method", factor() == 0 ? 0 : open, "pixels");
    RightEye eye;
    EyeImage right;
    const RightEyeTimings timings = eye.render(*stage.renderer, views, left, setting, right);
    row.saw(static_cast<double>(timings.holePixels));
}

INSTANTIATE_TEST_SUITE_P(Stability, SeparationRow,
                         testing::Combine(testing::Bool(),
                                          testing::Values(0.0, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0)),
                         [](const auto& given) {
                             return testName(std::string(std::get<0>(given.param) ? "terrain_" : "colon_") +
                                             shortNumber(std::get<1>(given.param)));
                         });

}  // namespace
}  // namespace stereonav
