// What one picture of 900x900 costs (Wyman et al. 2006, Table 1: lazy computation and path tracing): the
// texels that it looks up, or paths from each of its pixels, from a random part of them.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "tests/bench/bench_light_bake.h"
#include "tests/bench/bench_light_lookup.h"

namespace stereonav::bench {

struct OneView {
    std::vector<Brick> texels;       // of bricks seen, those on the surface shown
    std::vector<PointPiece> pixels;  // that show a surface, 64 together
    std::size_t texelCount = 0, pixelCount = 0;
};

inline OneView viewOf900(const LightSubject& subject) {
    constexpr int kSide = 900;
    constexpr std::size_t kTogether = 64;
    const ColonScene scene = lookupScene(subject);
    Lens lens = scene.lens;
    lens.width = lens.height = kSide;
    const EyeView view = makeEyeView(scene.startPose, lens);
    FrameTimes frame(scene.volume, view);
    frame.run();
    const GreyVolume& field = scene.volume.field;
    const float isovalue = scene.volume.cells.isovalue;
    const TexelChooser chooser(field, field.frame, {isovalue, isovalue, nullptr, false});
    const TexelLayout layout(field.frame.size);
    OneView one;
    for (const std::uint32_t number : bricksSeen(view, frame.image(), IlluminationVolume(field.frame))) {
        one.texels.push_back(texelsIn(layout, {number, chooser.brick(number)}));
        one.texelCount += one.texels.back().size();
    }
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const auto depth = static_cast<double>(frame.image().viewDepth.at(x, y));
            if (!(depth < static_cast<double>(kMissDepth))) continue;
            const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
            if (one.pixelCount++ % kTogether == 0) one.pixels.emplace_back();
            one.pixels.back().push_back({field.frame.voxelFromWorld(view.eye + depth * ray),
                                         static_cast<double>(isovalue), -glm::normalize(ray),
                                         static_cast<std::uint64_t>(y * kSide + x)});
        }
    one.texels = inSmallPieces(one.texels);
    std::shuffle(one.pixels.begin(), one.pixels.end(), std::mt19937(1));
    return one;
}

}  // namespace stereonav::bench
