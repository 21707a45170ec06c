#include "app/video_file.h"

#include <unistd.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "app/output_place.h"
#include "engine/base/error.h"
#include "engine/metrics/byte_image.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

int codecOf(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".mp4") return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    if (extension == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (extension == ".mkv") return cv::VideoWriter::fourcc('F', 'F', 'V', '1');
    return 0;
}

fs::path besides(const fs::path& file) {
    fs::path temporary = file;
    temporary.replace_filename("." + file.stem().string() + "." + std::to_string(getpid()) + ".part" +
                               file.extension().string());
    return temporary;
}

}  // namespace

struct VideoFile::State {
    fs::path file, temporary;
    cv::VideoWriter writer;
    int width = 0, height = 0;  // of a frame as given
    bool finished = false;
};

void checkVideoFile(const std::string& option, const fs::path& file) {
    if (codecOf(file) == 0)
        throw Error(option, "", "\"" + file.string() + "\" is not a kind of video that can be written",
                    "use .mp4, .avi or .mkv (lossless)");
    checkOutputFile(option, file);
}

VideoFile::VideoFile(const fs::path& file, double framesPerSecond, int width, int height)
    : mState(std::make_unique<State>()) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // its errors become ours
    mState->file = file;
    mState->temporary = besides(file);
    mState->width = width;
    mState->height = height;
    std::error_code code;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), code);
    const cv::Size size(width + width % 2, height + height % 2);
    if (!mState->writer.open(mState->temporary.string(), codecOf(file), framesPerSecond, size)) {
        fs::remove(mState->temporary, code);
        throw Error(file.string(), "", "can not be written as a video", "try another extension or folder");
    }
}

VideoFile::~VideoFile() {
    if (mState->finished) return;
    mState->writer.release();
    std::error_code code;
    fs::remove(mState->temporary, code);
}

void VideoFile::add(const Plane<PackedColor>& frame) {
    if (frame.width() != mState->width || frame.height() != mState->height)
        throw Error(mState->file.string(), "", "expected frames of one size",
                    "keep the size while recording");
    cv::Mat bytes = bytesFromPlane(frame);
    if (frame.width() % 2 || frame.height() % 2)
        cv::copyMakeBorder(bytes, bytes, 0, frame.height() % 2, 0, frame.width() % 2, cv::BORDER_REPLICATE);
    mState->writer.write(bytes);
}

void VideoFile::finish() {
    mState->writer.release();
    std::error_code code;
    fs::rename(mState->temporary, mState->file, code);
    if (code)
        throw Error(mState->file.string(), "", "can not be written", "check that the folder can be written");
    mState->finished = true;
}

}  // namespace stereonav
