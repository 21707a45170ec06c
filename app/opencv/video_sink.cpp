// The module stereonav_video: frames through OpenCV's videoio.
#include "app/output/video_sink.h"

#include <cstdint>
#include <cstdlib>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <vector>

#include "engine/base/module.h"
#include "engine/image/opencv/byte_image.h"

namespace stereonav {
namespace {

// A frame that OpenCV's writer hands to FFmpeg as it is. Others it copies first, into memory that it does not
// check for: rows whose bytes are no multiple of 32, and those that end at the border of a page.
class FrameBuffer {
public:
    FrameBuffer(int width, int height) {
        constexpr std::size_t kStep = 32, kPage = 4096;
        const std::size_t step = (3 * static_cast<std::size_t>(width) + kStep - 1) / kStep * kStep;
        const std::size_t bytes = step * static_cast<std::size_t>(height);
        mBytes.resize(bytes + 2 * kPage);
        const auto end = reinterpret_cast<std::uintptr_t>(mBytes.data()) + bytes;
        const std::size_t ahead = (kPage / 2 + kPage - end % kPage) % kPage;  // it ends half-way in a page
        mFrame = cv::Mat(height, width, CV_8UC3, mBytes.data() + ahead, step);
    }
    cv::Mat& frame() { return mFrame; }

private:
    std::vector<unsigned char> mBytes;
    cv::Mat mFrame;
};

class OpenCvSink final : public VideoSink {
public:
    bool open(const std::filesystem::path& file, const char* codec, double framesPerSecond, int width,
              int height) {
        const cv::Size size(width + width % 2, height + height % 2);
        mBuffer.emplace(size.width, size.height);
        mFile = file.string();
        return mWriter.open(file.string(), cv::CAP_FFMPEG,
                            cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), framesPerSecond,
                            size);
    }

    void add(const Plane<PackedColor>& frame) override {
        try {
            cv::copyMakeBorder(bytesFromPlane(frame), mBuffer->frame(), 0, frame.height() % 2, 0,
                               frame.width() % 2, cv::BORDER_REPLICATE);
            mWriter.write(mBuffer->frame());
        } catch (const cv::Exception& failed) {
            if (failed.code == cv::Error::StsNoMem) throw std::bad_alloc();
            throw;
        }
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
    std::optional<FrameBuffer> mBuffer;
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
