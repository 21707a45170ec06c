// The frames of a flight, one after the other, and what of them goes where: made and used in one process, or
// made in any and handed as bytes to the first (engine/peers).
#pragma once

#include <memory>
#include <vector>

#include "app/options/picture_options.h"
#include "app/output/stereo_frame.h"
#include "app/output/video_file.h"
#include "engine/camera/timed_poses.h"
#include "engine/peers/peer_bytes.h"

namespace stereonav {

// Frames by ascending numbers. Where eyes come together slowly, what lies between is passed by.
class FlightFrames {
public:
    FlightFrames(StereoFrame& frame, const std::vector<TimedPose>& poses) : mFrame(frame), mPoses(poses) {}
    const StereoFrame& make(std::size_t number);

private:
    StereoFrame& mFrame;
    const std::vector<TimedPose>& mPoses;
    std::size_t mNext = 0;
};

// Where frames go, and what is told of them; what was not asked for stays unused. All in their order.
class FrameSink {
public:
    // Makes the folder and begins the video. Throws Error.
    explicit FrameSink(const PlayOptions& options);

    void add(const StereoFrame& frame, std::size_t number);
    // As packed by another process, or this one.
    void add(std::span<const std::byte> packed, std::size_t number);
    void finish();

    std::uint64_t hash() const { return mHash.value(); }
    std::vector<double> left_ms, right_ms, both_ms;

private:
    void note(const FrameTimings& timings);
    void write(const std::vector<unsigned char>& png, std::size_t number) const;

    const PlayOptions& mOptions;
    std::unique_ptr<VideoFile> mVideo;
    Hash mHash;
};

// What the sink takes of a frame.
PeerBytes packedFrame(const StereoFrame& frame, const PlayOptions& options);
// Bytes of that for each pixel of an eye, at most; `eyes` of them in the composed picture.
double packedBytesAPixel(const PlayOptions& options, double eyes);

}  // namespace stereonav
