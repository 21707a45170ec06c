// Fields of built-in media, from functions of the place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "engine/base/parallel.h"
#include "engine/volume/volume.h"

namespace stereonav {

constexpr double kMostInField = 1000;  // the largest value

// Returns size^3 values in a cube `width` metres wide, with its low corner at `origin`. valueAt: returns the
// value at a place in metres; called by several threads; results are clamped to 0..kMostInField.
template <typename Value>
std::shared_ptr<GreyVolume> sampledField(int size, double width, const glm::dvec3& origin, Value valueAt) {
    VolumeFrame frame;
    frame.size = glm::ivec3(size);
    frame.spacing = glm::dvec3(width / size);
    frame.origin = origin + 0.5 * frame.spacing;
    auto field = std::make_shared<GreyVolume>(frame);
    parallelFor(size, [&](int k) {
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) {
                const double value = valueAt(frame.worldFromVoxel({i, j, k}));
                field->at(i, j, k) = static_cast<std::int16_t>(std::clamp(value, 0.0, kMostInField) + 0.5);
            }
    });
    return field;
}

}  // namespace stereonav
