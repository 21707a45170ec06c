// A medium with its look, setting and slices, seen by the plain sweep or the fast one: for tests that hold
// both against the same figures.
#pragma once

#include "engine/medium/sweep/medium_sweep.h"
#include "sweep_scenes.h"

namespace stereonav::test {

enum class Way { Plain, Fast };

struct Slab {
    Medium medium;
    MediumLook look;
    SweepSetting setting;
    SweepGeometry geometry;
};

inline std::string nameOfWay(const testing::TestParamInfo<Way>& way) {
    return way.param == Way::Plain ? "Plain" : "Fast";
}
inline MediumPicture pictureOf(const Slab& s, Way way) {
    if (way == Way::Plain) return plainSweep(s.medium, s.look, s.setting, s.geometry)[0];
    MediumSweep sweep(s.medium);
    MediumPicture picture;
    sweep.render(s.look, s.setting, s.geometry, 0, std::span(&picture, 1));
    return picture;
}
// A smooth ball whose extinction changes everywhere.
inline Slab ball(MediumModel model, int slices, const glm::dvec3& eye = {0.5, -3, 0.7}, double cone = 0.6) {
    static const std::shared_ptr<GreyVolume> field =
        makeField({33, 33, 33}, 2, {0, 0, 0}, [](const glm::ivec3& v) {
            const double r = glm::length(glm::dvec3(v - 16)) / 16;
            return r < 1 ? 20000 * (1 - r * r) * (1 - r * r) : 0.0;
        });
    Uniform dense{3.0, {1.0, 1.5, 2.0}};
    std::vector<MediumPoint> points{{0, {}}, {20000, materialOf(dense, 0.2)}};
    points[0].material.transport = glm::vec3(1.0f);
    Slab s{Medium(field, MediumTransfer(points, 0.2, "test")), {}, {}, {}};
    s.look.light = sun({0.6, 0.3, -0.8});
    s.look.model = model;
    s.setting.slices = slices;
    s.setting.lightSize = 96;
    s.setting.coneAngle = cone;
    s.setting.blurLength = 0.25;
    const EyeView view[] = {viewFrom(eye, {0, 0, 0}, 0.25, 8, 8)};
    s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, view, view[0].eye);
    return s;
}
inline double rootMeanSquare(const MediumPicture& a, const MediumPicture& b) {
    double sum = 0;
    for (int y = 0; y < a.light.height(); ++y)
        for (int x = 0; x < a.light.width(); ++x)
            for (int k = 0; k < 3; ++k)
                sum += std::pow(static_cast<double>(a.light.at(x, y)[k]) - b.light.at(x, y)[k], 2);
    return std::sqrt(sum / (3.0 * a.light.width() * a.light.height()));
}

}  // namespace stereonav::test
