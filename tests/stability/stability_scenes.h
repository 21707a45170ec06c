// What several stability tests look at: the instruction sets of this machine, small terrains and lumens.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav::test {

inline VolumeFrame frameOf(const glm::ivec3& size, const glm::dvec3& spacing) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    return frame;
}

// A volume whose value grows by `steepness` a metre across the wall of a shape from `low` to `high`; outside:
// signed distance to the wall in metres, positive in it, of a point in metres from the first voxel.
inline GreyVolume walledVolume(const VolumeFrame& frame,
                               const std::function<double(const glm::dvec3&)>& outside, double steepness,
                               double low = -1000, double high = 40) {
    GreyVolume volume(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const double d = outside(frame.spacing * glm::dvec3(i, j, k));
                const double value = 0.5 * (low + high) + steepness * d;
                volume.at(i, j, k) = static_cast<std::int16_t>(std::lround(std::clamp(value, low, high)));
            }
    return volume;
}

inline VolumeScene surfaceScene(GreyVolume field, double isovalue) {
    VolumeScene scene;
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = static_cast<float>(isovalue);
    Progress progress;
    scene.field = std::move(field);
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    return scene;
}

inline EyeImage castPicture(const EyeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    return image;
}

// Pixels whose colour or depth differ in a bit.
inline long long differentPixels(const EyeImage& a, const EyeImage& b) {
    long long different = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const float p = a.viewDepth.at(x, y), q = b.viewDepth.at(x, y);
            const bool same = p == q || (std::isnan(p) && std::isnan(q));
            different += !same || a.color.at(x, y) != b.color.at(x, y);
        }
    return different;
}

// Restores the number of threads.
class ThreadsBefore {
public:
    ThreadsBefore() : mThreads(threadCount()) {}
    ~ThreadsBefore() { setThreadCount(mThreads); }
    ThreadsBefore(const ThreadsBefore&) = delete;
    ThreadsBefore& operator=(const ThreadsBefore&) = delete;

private:
    int mThreads;
};

}  // namespace stereonav::test
