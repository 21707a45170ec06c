#include "app/command/play_frames.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/options/output_place.h"
#include "engine/base/file.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

template <typename T>
void putPlane(ByteWriter& to, const Plane<T>& plane) {
    to.put(plane.width()).put(plane.height());
    for (int y = 0; y < plane.height(); ++y)
        to.putAll(std::span<const T>(plane.row(y), static_cast<std::size_t>(plane.width())));
}

template <typename T>
Plane<T> planeOf(ByteReader& from) {
    const int width = from.get<int>(), height = from.get<int>();
    if (width < 0 || height < 0 ||
        from.left() / sizeof(T) / std::max(width, 1) < static_cast<unsigned>(height))
        throw Error("", "message between processes", "holds a picture of another size",
                    "start all processes from the same build");
    Plane<T> plane(width, height);
    for (int y = 0; y < height; ++y) from.getAll(std::span<T>(plane.row(y), static_cast<std::size_t>(width)));
    return plane;
}

std::vector<unsigned char> pngOf(const Plane<PackedColor>& picture) {
    return encodeColorImage(picture, ".png");
}

}  // namespace

const StereoFrame& FlightFrames::make(std::size_t number) {
    for (; mNext < number; ++mNext) mFrame.passBy(mPoses[mNext].pose, mPoses[mNext].time);
    mFrame.render(mPoses[number].pose, mPoses[number].time);
    mFrame.paint();
    mNext = number + 1;
    return mFrame;
}

FrameSink::FrameSink(const PlayOptions& options) : mOptions(options) {
    if (!options.out.empty()) makeOutputFolder(options.out);
    if (options.video.empty()) return;
    const auto [width, height] = composedSize(options.mode, options.size.width, options.size.height);
    mVideo =
        std::make_unique<VideoFile>(options.video, options.fps, width, height, stereoTagOf(options.mode));
}

void FrameSink::note(const FrameTimings& timings) {
    left_ms.push_back(timings.left_ms);
    right_ms.push_back(timings.right_ms);
    both_ms.push_back(timings.both_ms);
}

void FrameSink::write(const std::vector<unsigned char>& png, std::size_t number) const {
    writeTextFile(std::filesystem::path(mOptions.out) / fmt::format("frame_{:05d}.png", number),
                  {png.begin(), png.end()}, Flush::ToSystem);
}

void FrameSink::add(const StereoFrame& frame, std::size_t number) {
    note(frame.timings());
    if (mOptions.hash) frame.addTo(mHash);
    if (mOptions.out.empty() && !mVideo) return;
    const Plane<PackedColor> picture = frame.compose(mOptions.mode);
    if (!mOptions.out.empty()) write(pngOf(picture), number);
    if (mVideo) mVideo->add(picture);
}

PeerBytes packedFrame(const StereoFrame& frame, const PlayOptions& options) {
    ByteWriter to;
    const FrameTimings& timings = frame.timings();
    to.put(timings.left_ms).put(timings.right_ms).put(timings.both_ms);
    if (options.hash)
        for (const EyeImage* eye : {&frame.left(), &frame.right()})
            putPlane(to, eye->color), putPlane(to, eye->viewDepth);
    if (options.out.empty() && options.video.empty()) return to.take();
    const Plane<PackedColor> picture = frame.compose(options.mode);
    if (!options.out.empty()) to.putArray(std::span<const unsigned char>(pngOf(picture)));
    if (!options.video.empty()) putPlane(to, picture);
    return to.take();
}

void FrameSink::add(std::span<const std::byte> packed, std::size_t number) {
    ByteReader from(packed);
    FrameTimings timings;
    timings.left_ms = from.get<double>();
    timings.right_ms = from.get<double>();
    timings.both_ms = from.get<double>();
    note(timings);
    if (mOptions.hash)
        for (int eye = 0; eye < 2; ++eye) {
            hashPlane(mHash, planeOf<PackedColor>(from));
            hashPlane(mHash, planeOf<float>(from));
        }
    if (!mOptions.out.empty()) write(from.getArray<unsigned char>(), number);
    if (mVideo) mVideo->add(planeOf<PackedColor>(from));
}

void FrameSink::finish() {
    if (mVideo) mVideo->finish();
}

double packedBytesAPixel(const PlayOptions& options, double eyes) {
    const double picture = sizeof(PackedColor) * eyes;
    return (options.hash ? 2.0 * (sizeof(PackedColor) + sizeof(float)) : 0) +
           (options.out.empty() ? 0 : picture) + (options.video.empty() ? 0 : picture);
}

}  // namespace stereonav
