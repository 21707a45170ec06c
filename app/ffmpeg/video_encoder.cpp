#include "app/ffmpeg/video_encoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/image/yuv_planes.h"

extern "C" {
#include <libavutil/opt.h>
}

namespace stereonav {
namespace {

constexpr int kH264Slices = 4;
constexpr int kH264Lookahead = 10;  // frames; each holds 2.2 bytes a pixel, and the default is 40
constexpr int kJpegQuality = 2;     // on FFmpeg's scale, 2 to 31: the best that all decoders accept

int evenUp(int size) {
    return size + size % 2;
}

// Least rows or columns of a slice: FFmpeg's decoder (5.1) shows slices of one as black.
constexpr int kLeastFfv1 = 2;

// Returns n for n x n slices of a frame, each with at most 3.7 million pixels.
int ffv1Side(int width, int height) {
    constexpr double kMostOfSlice = 8.0 * (1 << 24) / (9 * 4);
    int side = std::min(width, height) >= 2 * kLeastFfv1 ? 2 : 1;
    const auto largest = [&side](int length) { return (length + side - 1) / side; };
    while (1.0 * largest(width) * largest(height) > kMostOfSlice) ++side;
    return side;
}

void setOption(AVCodecContext& codec, const char* name, const std::string& value, const std::string& file) {
    forgetAvMessages();
    const int code = av_opt_set(codec.priv_data, name, value.c_str(), 0);
    if (code < 0)
        throwAvFailure(code, file, fmt::format("can not be written as a video: {} {}", name, value));
}

// Threads share the slices of one frame, which takes no additional frames. There are always four, on every
// machine, since the output depends on their number.
void setH264(AVCodecContext& codec, const VideoOrder& order) {
    codec.width = evenUp(order.width);
    codec.height = evenUp(order.height);
    codec.pix_fmt = AV_PIX_FMT_YUV420P;
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.colorspace = AVCOL_SPC_BT709;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
    codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
    codec.thread_count = kH264Slices;
    codec.thread_type = FF_THREAD_SLICE;
    std::string more = fmt::format("rc-lookahead={}:cpu-independent=1", kH264Lookahead);
    if (order.stereo.framePacking >= 0) more += fmt::format(":frame-packing={}", order.stereo.framePacking);
    setOption(codec, "preset", "veryfast", order.name);
    setOption(codec, "crf", "16", order.name);
    setOption(codec, "x264-params", more, order.name);
}

void setJpeg(AVCodecContext& codec, const VideoOrder& order) {
    codec.width = evenUp(order.width);
    codec.height = evenUp(order.height);
    codec.pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec.color_range = AVCOL_RANGE_JPEG;
    codec.colorspace = AVCOL_SPC_BT470BG;
    codec.chroma_sample_location = AVCHROMA_LOC_CENTER;
    codec.flags |= AV_CODEC_FLAG_QSCALE;
    codec.global_quality = kJpegQuality * FF_QP2LAMBDA;
    codec.qmin = kJpegQuality;
}

// Slices are encoded independently: the output depends on their number only, and any number of threads can be
// used. Every frame is a key frame: a player can begin at any.
void setFfv1(AVCodecContext& codec, const VideoOrder& order) {
    codec.width = std::max(order.width, kLeastFfv1);
    codec.height = std::max(order.height, kLeastFfv1);
    const int side = ffv1Side(codec.width, codec.height);
    codec.pix_fmt = AV_PIX_FMT_BGR0;
    codec.color_range = AVCOL_RANGE_JPEG;
    codec.colorspace = AVCOL_SPC_RGB;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_IEC61966_2_1;
    codec.gop_size = 1;
    codec.level = 3;
    codec.slices = side * side;
    codec.thread_count = std::min(codec.slices, threadCount());
    codec.thread_type = FF_THREAD_SLICE;
    setOption(codec, "slicecrc", "1", order.name);
}

}  // namespace

const AVCodec& videoCodec(const std::string& name, VideoKind kind) {
    const AVCodec* codec = nullptr;
    switch (kind) {
        case VideoKind::Mp4:
            codec = avcodec_find_encoder_by_name("libx264");
            break;
        case VideoKind::Avi:
            codec = avcodec_find_encoder(AV_CODEC_ID_MJPEG);
            break;
        case VideoKind::Mkv:
            codec = avcodec_find_encoder(AV_CODEC_ID_FFV1);
            break;
    }
    if (codec) return *codec;
    if (kind == VideoKind::Mp4)
        throw Error(name, "", "H.264 can not be written: the libavcodec that is installed has no libx264",
                    "use .avi or .mkv (lossless), or install one that has it");
    throw Error(name, "", "the libavcodec that is installed can not write this kind of video",
                "use another extension");
}

VideoEncoder::VideoEncoder(const VideoOrder& order, bool globalHeader) : mOrder(order) {
    const AVCodec& codec = videoCodec(order.name, order.kind);
    mCodec.reset(allocated(avcodec_alloc_context3(&codec)));
    mFrame.reset(allocated(av_frame_alloc()));
    mPacket.reset(allocated(av_packet_alloc()));
    mCodec->framerate = av_d2q(order.framesPerSecond, 1'000'000);
    mCodec->time_base = av_inv_q(mCodec->framerate);
    mCodec->flags |= AV_CODEC_FLAG_BITEXACT;  // the same bytes in every run
    if (globalHeader) mCodec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    switch (order.kind) {
        case VideoKind::Mp4:
            setH264(*mCodec, order);
            break;
        case VideoKind::Avi:
            setJpeg(*mCodec, order);
            break;
        case VideoKind::Mkv:
            setFfv1(*mCodec, order);
            break;
    }
    forgetAvMessages();
    int code = 0;
    {
        const PrintedMessages printed;
        code = avcodec_open2(mCodec.get(), &codec, nullptr);
    }
    if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
    mFrame->format = mCodec->pix_fmt;
    mFrame->width = mCodec->width;
    mFrame->height = mCodec->height;
    mFrame->quality = mCodec->global_quality;
    code = av_frame_get_buffer(mFrame.get(), 0);
    if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
}

void VideoEncoder::fill(const Plane<PackedColor>& picture) {
    AVFrame& frame = *mFrame;
    if (mOrder.kind == VideoKind::Mkv) {
        bgr0FromPlane(picture, frame.data[0], frame.linesize[0], frame.width, frame.height);
        return;
    }
    yuvFromPlane(picture, mOrder.kind == VideoKind::Mp4 ? YuvRule::Bt709 : YuvRule::Jfif,
                 {frame.data[0], frame.data[1], frame.data[2], frame.linesize[0], frame.linesize[1],
                  frame.linesize[2]});
}

void VideoEncoder::send(const Plane<PackedColor>& picture) {
    forgetAvMessages();
    int code = av_frame_make_writable(mFrame.get());  // the codec may still hold the last frame
    if (code < 0) throwAvFailure(code, mOrder.name, "can not be coded");
    fill(picture);
    mFrame->pts = mSent++;
    const PrintedMessages printed;
    code = avcodec_send_frame(mCodec.get(), mFrame.get());
    if (code < 0) throwAvFailure(code, mOrder.name, "can not be coded");
}

void VideoEncoder::sendEnd() {
    forgetAvMessages();
    const PrintedMessages printed;
    const int code = avcodec_send_frame(mCodec.get(), nullptr);
    if (code < 0 && code != AVERROR_EOF) throwAvFailure(code, mOrder.name, "can not be coded");
}

AVPacket* VideoEncoder::receive() {
    const PrintedMessages printed;  // frames may be encoded during this call
    const int code = avcodec_receive_packet(mCodec.get(), mPacket.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return nullptr;
    if (code < 0) throwAvFailure(code, mOrder.name, "can not be coded");
    return mPacket.get();
}

}  // namespace stereonav
