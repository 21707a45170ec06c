// Scenes that make both eyes of a frame together, as a sweep through a medium does: what stands in the place
// of an EyeRenderer and a warp for them. Not for two threads at once; the work inside runs on all threads.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "engine/camera/stereo_rig.h"
#include "engine/image/eye_image.h"

namespace stereonav {

enum class PairMethod {
    Sweep,       // both eyes in one sweep, from one light; the right one reads what the left one saw
    OwnSamples,  // the same, but that each eye takes samples of its own
    TwoSweeps,   // a sweep for each eye: what the others are measured against
    DepthSplat   // the left eye's depths splatted to the right, whose rays start there (W12)
};
struct NamedPairMethod {
    std::string_view name;
    PairMethod method;
};
constexpr std::array<NamedPairMethod, 4> kPairMethods{{{"sweep", PairMethod::Sweep},
                                                       {"own-samples", PairMethod::OwnSamples},
                                                       {"two-sweeps", PairMethod::TwoSweeps},
                                                       {"depthsplat", PairMethod::DepthSplat}}};

struct PairTimings {
    double both_ms = 0;                // both eyes, all together
    double left_ms = 0, right_ms = 0;  // of each where they are made one after the other; else 0
    double splat_ms = 0;               // DepthSplat: in right_ms, before the right eye's sweep
    long long unknownPixels = 0;       // DepthSplat: right rays of which no start was known
};

class PairRenderer {
public:
    virtual ~PairRenderer() = default;
    // Sizes the images. time: seconds, of what moves by itself.
    virtual PairTimings renderPair(const StereoViews& views, double time, PairMethod method, EyeImage& left,
                                   EyeImage& right) = 0;
    virtual void renderOne(const EyeView& view, double time, EyeImage& image) = 0;
};

constexpr std::string_view nameOf(PairMethod method) {
    for (const NamedPairMethod& named : kPairMethods)
        if (named.method == method) return named.name;
    return "";
}
// "auto" is the sweep. Throws Error with the known names.
PairMethod pairMethodFromText(const std::string& name, const char* option = "--method");

}  // namespace stereonav
