// What video files ask of the module stereonav_video (FFmpeg); app/ffmpeg has it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/output/stereo_tag.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

struct VideoOrder {
    std::filesystem::path file;  // that is written
    std::string name;            // what messages call it
    VideoKind kind = VideoKind::Mkv;
    double framesPerSecond = 25;  // 0.001 to 1000
    int width = 0, height = 0;    // of a frame
    StereoTag stereo;
};

// A video that is being written, to one thread.
class VideoSink {
public:
    virtual ~VideoSink() = default;
    // Frames of the size that it was opened with. Throws Error.
    virtual void add(const Plane<PackedColor>& frame) = 0;
    // Ends the file. False where it does not hold every frame that was added: the disk was full.
    virtual bool close() = 0;
};

// Throws Error naming `name` where this kind can not be written here, whatever the file.
void checkVideoCodec(const std::string& name, VideoKind kind);
// Throws Error where the file can not be written. Odd sizes get a repeated last column or row; of
// .mkv those of one pixel alone.
std::unique_ptr<VideoSink> openVideoSink(const VideoOrder& order);

struct VideoFunctions {
    decltype(&stereonav::checkVideoCodec) check;
    decltype(&stereonav::openVideoSink) open;
};

}  // namespace stereonav
