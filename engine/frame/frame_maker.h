// Makes frames of a scene, both eyes, in the scene's own way. Commands and the window use this and need not
// know what is behind it: rays and a warped right eye (cast_frames.h), or a sweep through a medium for both
// (engine/medium/sweep/swept_frames.h).
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

// How both eyes are made.
struct FrameWay {
    std::string_view method;  // one of FrameMaker::methods(); "": the default
    WarpSetting warp{};       // settings for methods that warp; the method in it is not used
    EdgeSetting edges{};      // rays at edges, where rays are cast
};

// Returns the way with this setting, and with its method.
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

// Memory that is held between frames, without the pictures.
struct HeldBytes {
    const char* what;
    std::size_t bytes;
};

// Pixels where the last right eye was not taken from the left one.
struct RightHoles {
    const Plane<std::uint8_t>& mask;  // 255 in holes, 0 elsewhere; valid until the next right eye is made
    bool open = false;                // holes are black, instead of cast
};

// Methods that use a given left eye unchanged and differ only in the right eye. Here that is made by itself,
// so that many ways can be tried on a left eye that is made once.
class RightFromLeft {
public:
    virtual ~RightFromLeft() = default;
    // Makes a right eye. left: the left eye of these views from FrameMaker::make, without rays for its edges,
    // since those would be warped with what lies beside them; the right eye gets none either. Sizes the
    // image. Throws Error as make().
    virtual RightEyeTimings makeRight(const StereoViews& views, const EyeImage& left, const FrameWay& way,
                                      EyeImage& right) = 0;
    // Smooths an eye's edges in the given way, to be called after the right eye was made: EdgeRays::smooth.
    virtual EdgeTimings smoothEdges(const EyeView& view, const FrameWay& way, EyeImage& image) = 0;
    // Returns the holes of the last right eye from makeRight() or FrameMaker::make().
    virtual RightHoles holes() const = 0;
};

// Makes frames. Not for two threads at once; the work inside runs on all threads.
class FrameMaker {
public:
    virtual ~FrameMaker() = default;

    // Returns the names of the methods for two eyes, in a fixed order; the texts stay valid for ever.
    virtual std::span<const std::string_view> methods() const = 0;
    // Returns the method for the name "".
    virtual std::string_view defaultMethod() const = 0;
    // Returns the method that makes each eye alone, against which the others are measured.
    virtual std::string_view exactMethod() const = 0;
    // The methods that a comparison runs when none are named, in the order of methods().
    virtual std::vector<std::string_view> compared() const { return {methods().begin(), methods().end()}; }
    // Returns a name for the part of a frame in which methods differ, such as "right eye"; the rest is the
    // same for all.
    virtual std::string_view whatMethodsMake() const = 0;

    // Makes both eyes; sizes the images. time: seconds, for animation. Throws Error for a method that is not
    // among methods().
    virtual void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) = 0;
    // Makes one eye, into frame.left.
    virtual void makeOne(const EyeView& view, double time, EyePair& frame) = 0;
    // Returns an interface that makes the right eye alone; null where methods make both eyes together, or
    // each its own left eye.
    virtual RightFromLeft* rightFromLeft() { return nullptr; }

    // Returns the fastest plan, by measurements on frames like these (all of one size, at least one); empty
    // where there is no choice.
    virtual std::optional<FramePlan> measure(std::span<const StereoViews>) { return std::nullopt; }
    // Returns the cheapest way that fulfils a wish for quality, by measurements on frames like these
    // (quality_plan.h). method: the method to keep, or "" for any. Empty where methods have no such setting.
    // Throws Error.
    virtual std::optional<QualityPlan> meet(const QualityWish&, std::string_view /*method*/,
                                            std::span<const StereoViews>) {
        return std::nullopt;
    }

    // Returns the memory that is held now, a row for each kind.
    virtual std::vector<HeldBytes> held() const { return {}; }
};

}  // namespace stereonav
