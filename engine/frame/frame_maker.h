// One frame of a scene: both eyes, by whatever way the scene has of making them. Commands and the window make
// their frames through this and need not know what is behind it: rays and a warped right eye (cast_frames.h),
// or a sweep through a medium for both (engine/medium/sweep/swept_frames.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/image/eye_image.h"
#include "engine/sampling/edge_rays.h"
#include "engine/stereo/frame_plan.h"
#include "engine/stereo/quality_plan.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// How the eyes are to be made.
struct FrameWay {
    std::string_view method;  // one of FrameMaker::methods(); "": the default
    WarpSetting warp{};       // how methods that warp do it: all but which one it is
    EdgeSetting edges{};      // rays at edges, where rays are cast
};

// Returns the way of a setting, its method too.
inline FrameWay wayOf(const WarpSetting& setting) {
    return {nameOf(setting.method), setting};
}

// Times of the parts of a frame.
struct FrameTimings {
    double both_ms = 0;                     // the whole frame
    double left_ms = 0, right_ms = 0;       // each eye; 0 where they are made together
    std::optional<RightEyeTimings> warped;  // where the right eye came from the left one
    EdgeTimings edges;                      // both eyes; its time is part of theirs
};

// The two pictures of a frame.
struct EyePair {
    EyeImage left, right;  // right: without pixels where one eye was made
    FrameTimings timings;
};

// Memory that is held between frames beside the pictures.
struct HeldBytes {
    const char* what;
    std::size_t bytes;
};

// Where the last right eye was not taken from the left one.
struct RightHoles {
    const Plane<std::uint8_t>& mask;  // 255 there, 0 elsewhere; until the next right eye is made
    bool open = false;                // holes are black, instead of cast
};

// Methods that take one left eye as it is and differ in the right one alone: that one by itself, so that many
// ways of making it can be tried on a left eye that is made once.
class RightFromLeft {
public:
    virtual ~RightFromLeft() = default;
    // left: the left eye of these views as FrameMaker::make gives it, without rays for its edges: they would
    // be warped with what lies beside them. Nor does the right eye get any. Sizes the image. Throws Error as
    // make().
    virtual RightEyeTimings makeRight(const StereoViews& views, const EyeImage& left, const FrameWay& way,
                                      EyeImage& right) = 0;
    // Smooths an eye's edges in the given way, once the right eye was made: EdgeRays::smooth.
    virtual EdgeTimings smoothEdges(const EyeView& view, const FrameWay& way, EyeImage& image) = 0;
    // The holes of the last right eye, by makeRight() or FrameMaker::make().
    virtual RightHoles holes() const = 0;
};

// Makes frames. Not for two threads at once; the work inside runs on all threads.
class FrameMaker {
public:
    virtual ~FrameMaker() = default;

    // Names of the ways to two eyes, in a fixed order, all valid for ever.
    virtual std::span<const std::string_view> methods() const = 0;
    // The method that "" stands for.
    virtual std::string_view defaultMethod() const = 0;
    // The method that makes each eye by itself: what the others are measured against.
    virtual std::string_view exactMethod() const = 0;
    // The methods that a comparison runs when none are named, in the order of methods().
    virtual std::vector<std::string_view> compared() const { return {methods().begin(), methods().end()}; }
    // Names the pictures that these methods make, as in "right eye": the rest is the same for all.
    virtual std::string_view whatMethodsMake() const = 0;

    // Makes both eyes; sizes the images. time: seconds, for what moves by itself. Throws Error for a method
    // that is not among methods().
    virtual void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) = 0;
    // Makes one eye, into frame.left.
    virtual void makeOne(const EyeView& view, double time, EyePair& frame) = 0;
    // Returns what makes the right eye alone; null where methods make both eyes together, or one each its own
    // way.
    virtual RightFromLeft* rightFromLeft() { return nullptr; }

    // Returns by measuring which method is worth its time on frames like these (all of one size, at least
    // one); nothing where there is nothing to weigh.
    virtual std::optional<FramePlan> measure(std::span<const StereoViews>) { return std::nullopt; }
    // Returns the way that meets a wish for quality at the least cost, measured on frames like these
    // (quality_plan.h). method: to be kept, or "" for any. Returns nothing where methods have no such dial.
    // Throws Error.
    virtual std::optional<QualityPlan> meet(const QualityWish&, std::string_view /*method*/,
                                            std::span<const StereoViews>) {
        return std::nullopt;
    }

    // Returns what is held now, a row for each kind.
    virtual std::vector<HeldBytes> held() const { return {}; }
};

}  // namespace stereonav
