// The codec of one kind of video, with the frame that it is given.
#pragma once

#include "app/ffmpeg/handles.h"
#include "app/output/video_sink.h"

namespace stereonav {

class VideoEncoder {
public:
    // globalHeader: what a player needs first goes before the frames and not into them. Throws Error.
    VideoEncoder(const VideoOrder& order, bool globalHeader);

    const AVCodecContext& context() const { return *mCodec; }
    void send(const Plane<PackedColor>& picture);
    void sendEnd();
    // Null where the next one needs more frames, or after the end. Valid until the next call.
    AVPacket* receive();

private:
    void fill(const Plane<PackedColor>& picture);

    VideoOrder mOrder;
    AvOwned<AVCodecContext> mCodec;
    AvOwned<AVFrame> mFrame;
    AvOwned<AVPacket> mPacket;
    std::int64_t mSent = 0;
};

// The codec that writes this kind here. Throws Error naming `name` where there is none.
const AVCodec& videoCodec(const std::string& name, VideoKind kind);

}  // namespace stereonav
