// FFmpeg's objects with owners, and its failures as exceptions.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <memory>
#include <string>

namespace stereonav {

struct AvFree {
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
template <typename T>
using AvOwned = std::unique_ptr<T, AvFree>;

// What FFmpeg and its codecs say is kept, not printed: it becomes the program's own lines.
void keepAvMessages();
void forgetAvMessages();  // before a call whose failure is told

// While one lives, what x264 prints on standard error is kept in the same way: it tells of an allocation that
// failed there alone. All else that is printed passes.
class PrintedMessages {
public:
    PrintedMessages();
    ~PrintedMessages();
    PrintedMessages(const PrintedMessages&) = delete;
    PrintedMessages& operator=(const PrintedMessages&) = delete;
};

// Throws bad_alloc where an allocation failed, as the code or the codec's own message says; else Error naming
// `name`, with `problem` and what was said.
[[noreturn]] void throwAvFailure(int code, const std::string& name, const std::string& problem);

// A pointer that only a lack of memory makes null.
template <typename T>
T* allocated(T* pointer) {
    if (!pointer) throw std::bad_alloc();
    return pointer;
}

}  // namespace stereonav
