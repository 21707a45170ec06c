// What video files ask of the module stereonav_video (OpenCV); app/opencv has it.
#pragma once

#include <filesystem>
#include <memory>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// A video that is being written, to one thread.
class VideoSink {
public:
    virtual ~VideoSink() = default;
    // Frames of the size that it was opened with.
    virtual void add(const Plane<PackedColor>& frame) = 0;
    // Ends the file. False where it does not hold every frame that was added: the disk was full.
    virtual bool close() = 0;
};

// Null where `file` can not be written. codec: four letters. Odd sizes get a repeated last column or row.
std::unique_ptr<VideoSink> openVideoSink(const std::filesystem::path& file, const char* codec,
                                         double framesPerSecond, int width, int height);

struct VideoFunctions {
    decltype(&stereonav::openVideoSink) open;
};

}  // namespace stereonav
