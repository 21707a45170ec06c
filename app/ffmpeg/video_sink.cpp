// The module stereonav_video: frames through FFmpeg's libraries.
#include "app/output/video_sink.h"

#include "app/ffmpeg/stereo_mode.h"
#include "app/ffmpeg/video_encoder.h"
#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/base/stop.h"

extern "C" {
#include <libavutil/dict.h>
#include <libavutil/stereo3d.h>
}

namespace stereonav {
namespace {

// Returns the file as a URL; the prefix makes FFmpeg take any name as a path.
std::string urlOf(const std::filesystem::path& file) {
    return "file:" + file.string();
}

const char* containerOf(VideoKind kind) {
    switch (kind) {
        case VideoKind::Mp4:
            return "mp4";
        case VideoKind::Avi:
            return "avi";
        case VideoKind::Mkv:
            break;
    }
    return "matroska";
}

struct MuxerFree {
    void operator()(AVFormatContext* muxer) const {
        avio_closep(&muxer->pb);
        avformat_free_context(muxer);
    }
};

class FfmpegSink final : public VideoSink {
public:
    explicit FfmpegSink(const VideoOrder& order)
        : mOrder(order),
          mMuxer(muxerOf(order)),
          mEncoder(order, (mMuxer->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
        mStream = allocated(avformat_new_stream(mMuxer.get(), nullptr));
        int code = avcodec_parameters_from_context(mStream->codecpar, &mEncoder.context());
        if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
        mStream->time_base = mEncoder.context().time_base;
        mStream->avg_frame_rate = mEncoder.context().framerate;
        sayStereo();
        forgetAvMessages();
        code = avio_open(&mMuxer->pb, mMuxer->url, AVIO_FLAG_WRITE);
        if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
        AVDictionary* options = nullptr;
        code = 0;
        // The index goes to the beginning, so that a player can begin before it has the whole file.
        if (order.kind == VideoKind::Mp4) code = av_dict_set(&options, "movflags", "+faststart", 0);
        if (hasStandIn()) code = av_dict_set(&options, "write_crc", "0", 0);
        if (code >= 0) code = avformat_write_header(mMuxer.get(), &options);
        av_dict_free(&options);
        if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
    }

    void add(const Plane<PackedColor>& frame) override {
        mEncoder.send(frame);
        writePackets();
        ++mAdded;
        if (!mWritten)  // the remaining packets would be encoded for nothing
            throw Error(mOrder.name, "", "can not be written: not all of it arrived",
                        "check that the disk has room");
    }

    // Compares the packets that were written with the frames that were added, without decoding.
    bool close() override {
        mEncoder.sendEnd();
        writePackets();
        forgetAvMessages();
        int code = av_write_trailer(mMuxer.get());
        if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
        avio_flush(mMuxer->pb);
        if (mMuxer->pb->error < 0) code = mMuxer->pb->error;
        const int closed = avio_closep(&mMuxer->pb);
        if (!mWritten || code < 0 || closed < 0) return false;
        if (hasStandIn() && !replaceStandIn(mOrder.file, mOrder.stereo.matroska)) return false;
        return framesWritten() == mAdded;
    }

private:
    static AVFormatContext* muxerOf(const VideoOrder& order) {
        keepAvMessages();
        AVFormatContext* muxer = nullptr;
        const int code = avformat_alloc_output_context2(&muxer, nullptr, containerOf(order.kind),
                                                        urlOf(order.file).c_str());
        if (code < 0) throwAvFailure(code, order.name, "can not be written as a video");
        muxer->flags |= AVFMT_FLAG_BITEXACT;  // neither random numbers nor times: the same bytes in every run
        muxer->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;  // for st3d in MP4
        return muxer;
    }

    bool hasStandIn() const { return mOrder.kind == VideoKind::Mkv && needsStandIn(mOrder.stereo.matroska); }

    void sayStereo() {
        const StereoTag& stereo = mOrder.stereo;
        if (mOrder.kind == VideoKind::Mkv && stereo.matroska >= 0) {
            const int said = hasStandIn() ? kStandInStereoMode : stereo.matroska;
            const int code = av_dict_set_int(&mStream->metadata, "stereo_mode", said, 0);
            if (code < 0) throw std::bad_alloc();
            mStream->sample_aspect_ratio = {stereo.aspectWidth, stereo.aspectHeight};
        }
        if (mOrder.kind != VideoKind::Mp4 || stereo.st3d < 0) return;
        constexpr AVStereo3DType kTypes[] = {AV_STEREO3D_2D, AV_STEREO3D_TOPBOTTOM, AV_STEREO3D_SIDEBYSIDE};
        auto* said = reinterpret_cast<AVStereo3D*>(
            allocated(av_stream_new_side_data(mStream, AV_PKT_DATA_STEREO3D, sizeof(AVStereo3D))));
        *said = {};
        said->type = kTypes[stereo.st3d];
    }

    // Writes the packets; after the first failed write none is written.
    void writePackets() {
        while (AVPacket* packet = mEncoder.receive()) {
            throwIfStopped();
            packet->stream_index = mStream->index;
            packet->duration = 1;
            av_packet_rescale_ts(packet, mEncoder.context().time_base, mStream->time_base);
            const int code = mWritten ? av_write_frame(mMuxer.get(), packet) : 0;
            av_packet_unref(packet);
            if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
            if (code < 0) mWritten = false;
        }
    }

    long long framesWritten() const {
        AVFormatContext* file = nullptr;
        if (avformat_open_input(&file, urlOf(mOrder.file).c_str(), nullptr, nullptr) < 0) return -1;
        long long frames = 0;
        const AvOwned<AVPacket> packet(av_packet_alloc());
        while (packet && av_read_frame(file, packet.get()) >= 0) {
            ++frames;
            av_packet_unref(packet.get());
        }
        avformat_close_input(&file);
        return frames;
    }

    VideoOrder mOrder;
    std::unique_ptr<AVFormatContext, MuxerFree> mMuxer;
    VideoEncoder mEncoder;
    AVStream* mStream = nullptr;  // owned by the muxer
    long long mAdded = 0;
    bool mWritten = true;
};

}  // namespace

void checkVideoCodec(const std::string& name, VideoKind kind) {
    videoCodec(name, kind);
}

std::unique_ptr<VideoSink> openVideoSink(const VideoOrder& order) {
    return std::make_unique<FfmpegSink>(order);
}

static constexpr VideoFunctions kFunctions = {checkVideoCodec, openVideoSink};
const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
