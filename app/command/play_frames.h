// The frames of a flight in their order, and their output: made and used in one process, or made in any
// process and passed as bytes to the first (engine/peers).
#pragma once

#include <memory>
#include <vector>

#include "app/command/play_command.h"
#include "app/output/stereo_frame.h"
#include "app/output/video_file.h"
#include "engine/camera/timed_poses.h"
#include "engine/peers/peer_bytes.h"

namespace stereonav {

// Makes frames with ascending numbers. Frames that are skipped still move the eyes, which come together
// slowly.
class FlightFrames {
public:
    FlightFrames(StereoFrame& frame, const std::vector<TimedPose>& poses) : mFrame(frame), mPoses(poses) {}
    const StereoFrame& make(std::size_t number);

private:
    StereoFrame& mFrame;
    const std::vector<TimedPose>& mPoses;
    std::size_t mNext = 0;
};

// The output of frames, and their times; what was not asked for stays unused. Frames are added in their
// order.
class FrameSink {
public:
    // Makes the folder and begins the video. Throws Error.
    explicit FrameSink(const PlayOptions& options);

    void add(const StereoFrame& frame, std::size_t number);
    // Adds a frame packed by packedFrame(), in this or another process.
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

// Returns the data of a frame that the sink needs.
PeerBytes packedFrame(const StereoFrame& frame, const PlayOptions& options);
// Returns the largest number of these bytes per pixel of an eye; the composed picture has `eyes` times its
// pixels.
double packedBytesAPixel(const PlayOptions& options, double eyes);

}  // namespace stereonav
