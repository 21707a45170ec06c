// Owners of FFmpeg's objects, and exceptions for its failures.
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

// Keeps the messages of FFmpeg and its codecs instead of printing them: they become part of the program's
// own.
void keepAvMessages();
void forgetAvMessages();  // to be called before a call whose failure is reported

// Keeps, while one exists, also what x264 prints on standard error: only there it reports a failed
// allocation. All other output passes.
class PrintedMessages {
public:
    PrintedMessages();
    ~PrintedMessages();
    PrintedMessages(const PrintedMessages&) = delete;
    PrintedMessages& operator=(const PrintedMessages&) = delete;
};

// Throws bad_alloc where an allocation failed, by the code or the codec's message; otherwise Error that names
// `name`, with `problem` and the message.
[[noreturn]] void throwAvFailure(int code, const std::string& name, const std::string& problem);

// Returns the pointer; throws bad_alloc where it is null, which only a lack of memory can cause.
template <typename T>
T* allocated(T* pointer) {
    if (!pointer) throw std::bad_alloc();
    return pointer;
}

}  // namespace stereonav
