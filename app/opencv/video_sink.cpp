// The module stereonav_video: frames through OpenCV's videoio.
#include "app/output/video_sink.h"

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "engine/base/module.h"
#include "engine/image/opencv/byte_image.h"

namespace stereonav {
namespace {

class OpenCvSink final : public VideoSink {
public:
    bool open(const std::filesystem::path& file, const char* codec, double framesPerSecond, int width,
              int height) {
        const cv::Size size(width + width % 2, height + height % 2);
        mFile = file.string();
        return mWriter.open(file.string(), cv::CAP_FFMPEG,
                            cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), framesPerSecond,
                            size);
    }

    void add(const Plane<PackedColor>& frame) override {
        cv::Mat bytes = bytesFromPlane(frame);
        if (frame.width() % 2 || frame.height() % 2)
            cv::copyMakeBorder(bytes, bytes, 0, frame.height() % 2, 0, frame.width() % 2,
                               cv::BORDER_REPLICATE);
        mWriter.write(bytes);
        ++mAdded;
    }

    // The writer tells of nothing that goes wrong, so what it wrote is counted: as packets, not decoded.
    bool close() override {
        mWriter.release();
        cv::VideoCapture written(mFile);
        if (!written.isOpened()) return false;
        written.set(cv::CAP_PROP_FORMAT, -1);
        long long frames = 0;
        while (written.grab()) ++frames;
        return frames == mAdded;
    }

private:
    cv::VideoWriter mWriter;
    std::string mFile;
    long long mAdded = 0;
};

}  // namespace

std::unique_ptr<VideoSink> openVideoSink(const std::filesystem::path& file, const char* codec,
                                         double framesPerSecond, int width, int height) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // its errors become ours
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);                              // and those of FFmpeg
    auto sink = std::make_unique<OpenCvSink>();
    if (!sink->open(file, codec, framesPerSecond, width, height)) return nullptr;
    return sink;
}

static constexpr VideoFunctions kFunctions = {openVideoSink};
const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
