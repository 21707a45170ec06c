// The codec of one kind of video, and the frame that is passed to it.
#pragma once

#include "app/ffmpeg/handles.h"
#include "app/output/video_sink.h"

namespace stereonav {

class VideoEncoder {
public:
    // globalHeader: the codec's header precedes the frames instead of being part of them. Throws Error.
    VideoEncoder(const VideoOrder& order, bool globalHeader);

    const AVCodecContext& context() const { return *mCodec; }
    void send(const Plane<PackedColor>& picture);
    void sendEnd();
    // Returns null where the next packet needs more frames, or after the end. Valid until the next call.
    AVPacket* receive();

private:
    void fill(const Plane<PackedColor>& picture);

    VideoOrder mOrder;
    AvOwned<AVCodecContext> mCodec;
    AvOwned<AVFrame> mFrame;
    AvOwned<AVPacket> mPacket;
    std::int64_t mSent = 0;
};

// Returns the codec for this kind of video. Throws Error that names `name` where there is none.
const AVCodec& videoCodec(const std::string& name, VideoKind kind);

}  // namespace stereonav
