// The interface of the module stereonav_video (FFmpeg), which app/ffmpeg implements.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/output/stereo_tag.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

struct VideoOrder {
    std::filesystem::path file;  // file to write
    std::string name;            // name in messages
    VideoKind kind = VideoKind::Mkv;
    double framesPerSecond = 25;  // 0.001 to 1000
    int width = 0, height = 0;    // size of a frame
    StereoTag stereo;
};

// A video that is being written; to be used by one thread.
class VideoSink {
public:
    virtual ~VideoSink() = default;
    // Adds a frame of the video's size. Throws Error.
    virtual void add(const Plane<PackedColor>& frame) = 0;
    // Ends the file. Returns false where it does not hold every frame that was added: the disk was full.
    virtual bool close() = 0;
};

// Throws Error that names `name` where this kind of video can not be written here, whatever the file.
void checkVideoCodec(const std::string& name, VideoKind kind);
// Throws Error where the file can not be written. Odd sizes get a repeated last column or row; in .mkv only
// those of one pixel.
std::unique_ptr<VideoSink> openVideoSink(const VideoOrder& order);

struct VideoFunctions {
    decltype(&stereonav::checkVideoCodec) check;
    decltype(&stereonav::openVideoSink) open;
};

}  // namespace stereonav
