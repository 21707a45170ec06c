// All that a sweep is asked for, and the same with each part of it changed in turn: for tests that hold what
// is kept between frames against frames that are made anew.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "engine/medium/sweep/sweep_geometry.h"
#include "tests/support/each_member.h"

namespace stereonav::test {

struct AskedSweep {
    MediumLook look;
    SweepSetting setting;
    std::vector<EyeView> eyes;
    double time = 0;  // seconds
};

template <>
struct Members<MediumLight> {
    static constexpr std::array names{"kind",      "direction", "position", "atHead",
                                      "coneAngle", "falloff",   "radiance"};
};
template <>
struct Members<BakedLook> {
    static constexpr std::array names{"light", "beyond", "use", "exposure", "lampShare", "lookup"};
};
template <>
struct Members<MediumLook> {
    static constexpr std::array names{"model",   "light",   "phase",    "indirectShare", "background",
                                      "ambient", "diffuse", "specular", "shininess",     "baked"};
};
template <>
struct Members<SweepSetting> {
    static constexpr std::array names{"slices",     "turn",         "lightSize",   "coneAngle",
                                      "blurLength", "shadingWidth", "sharedWidth", "singleTarget"};
};
template <>
struct Members<EyeView> {
    static constexpr std::array names{"eye",  "right", "up",    "forward", "head",      "xMin", "xMax",
                                      "yMin", "yMax",  "width", "height",  "nearDepth", "fall"};
};
template <>
struct Members<AskedSweep> {
    static constexpr std::array names{"look", "setting", "eyes", "time"};
};

// Light of any colour at the texels of a grid; some of them are not known, or all are.
inline std::shared_ptr<const IlluminationVolume> anyLight(VolumeFrame frame, unsigned seed,
                                                          bool all = false) {
    frame.size = {9, 8, 10};
    frame.spacing *= 1.9;
    auto light = std::make_shared<IlluminationVolume>(frame);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(0, 1);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const float red = number(random), green = number(random), blue = number(random);
                if (all || number(random) < 0.8f)
                    light->texels[light->layout.index(i, j, k)] = packTexel({red, green, blue}, 1);
            }
    return light;
}

inline bool canBeAsked(const AskedSweep& asked) {
    return std::all_of(asked.eyes.begin(), asked.eyes.end(), [](const EyeView& eye) {
        return eye.width > 0 && eye.height > 0 && eye.xMin < eye.xMax && eye.yMin < eye.yMax;
    });
}

// base: of two eyes, with a medium that has that frame. Turned eyes, other phase functions and other baked
// light are changed here by hand, and ways are made unit vectors again.
inline std::vector<Changed<AskedSweep>> sweepsBeside(const AskedSweep& base, const VolumeFrame& frame) {
    std::vector<std::string> byHand{"look.phase",        "look.baked.light", "look.baked.beyond",
                                    "look.baked.lookup", "look.background",  "setting.turn"};
    for (const char* const eye : {"eyes[0]", "eyes[1]"})
        for (const char* const axis : {".right", ".up", ".forward"})
            byHand.push_back(std::string(eye) + axis);
    std::vector<Changed<AskedSweep>> changes;
    for (Changed<AskedSweep> changed : eachMemberChanged(base, byHand)) {
        changed.value.look.light.direction = glm::normalize(changed.value.look.light.direction);
        if (canBeAsked(changed.value)) changes.push_back(changed);
    }
    const auto add = [&](const std::string& what) -> AskedSweep& {
        changes.push_back({what, base});
        return changes.back().value;
    };
    add("the turn").setting.turn = 0.5;
    add("a phase function").look.phase = PhaseFunction::henyeyGreenstein({0.5f, 0.25f, -0.25f});
    add("another phase function").look.phase = PhaseFunction::henyeyGreenstein({0.5f, 0.25f, -0.5f});
    add("no phase function").look.phase = {};
    add("baked light").look.baked.light = anyLight(frame, 7);
    add("no baked light").look.baked.light = nullptr;
    add("light beyond").look.baked.beyond = anyLight(frame, 8, true);
    for (std::size_t n = 0; n < base.eyes.size(); ++n) {
        EyeView& eye = add("a turned eye").eyes[n];
        const glm::dvec3 forward = std::cos(0.1) * eye.forward + std::sin(0.1) * eye.right;
        eye.right = std::cos(0.1) * eye.right - std::sin(0.1) * eye.forward;
        eye.forward = forward;
    }
    return changes;
}

}  // namespace stereonav::test
