// FFmpeg's log. The last error is kept, since codecs report reasons there that their results do not have.
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string_view>

#include "app/ffmpeg/handles.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

std::mutex messageMutex;  // encoders have threads of their own
char lastMessage[256];    // fixed size, as there may be no memory to allocate

void keepMessage(void*, int level, const char* format, std::va_list values) {
    if (level > AV_LOG_ERROR) return;
    const std::lock_guard lock(messageMutex);
    std::vsnprintf(lastMessage, sizeof lastMessage, format, values);
    lastMessage[std::strcspn(lastMessage, "\n")] = '\0';
}

// Write function of a stream that replaces standard error. x264 prints its name and then the message in
// separate calls.
ssize_t takePrinted(void*, const char* text, std::size_t bytes) {
    static bool ofX264 = false;
    constexpr std::string_view kName = "x264 [";
    const std::string_view part(text, bytes);
    if (part.starts_with(kName)) ofX264 = true;
    if (!ofX264) return write(STDERR_FILENO, text, bytes);
    if (!part.ends_with('\n') && part.starts_with(kName)) return static_cast<ssize_t>(bytes);
    const std::lock_guard lock(messageMutex);
    const std::size_t kept = std::min(part.find('\n'), sizeof lastMessage - 1);
    lastMessage[part.copy(lastMessage, kept)] = '\0';
    ofX264 = false;
    return static_cast<ssize_t>(bytes);
}

std::FILE* printedStream() {
    static std::FILE* const stream = [] {
        cookie_io_functions_t functions{};
        functions.write = takePrinted;
        std::FILE* made = fopencookie(nullptr, "w", functions);
        if (made) std::setvbuf(made, nullptr, _IONBF, 0);
        return made;
    }();
    return stream;
}

std::FILE* standardError = nullptr;  // set while another stream replaces it

}  // namespace

PrintedMessages::PrintedMessages() {
    std::FILE* const instead = printedStream();
    if (!instead || standardError) return;
    standardError = stderr;
    stderr = instead;
}

PrintedMessages::~PrintedMessages() {
    if (standardError) stderr = standardError;
    standardError = nullptr;
}

void keepAvMessages() {
    av_log_set_callback(keepMessage);
}

void forgetAvMessages() {
    const std::lock_guard lock(messageMutex);
    lastMessage[0] = '\0';
}

void throwAvFailure(int code, const std::string& name, const std::string& problem) {
    std::string said;
    {
        const std::lock_guard lock(messageMutex);
        said = lastMessage;
    }
    // x264 fails with a general error code; only its message has the reason: "malloc of size N failed".
    const bool noMemory = code == AVERROR(ENOMEM) || said.find("malloc") != std::string::npos;
    if (noMemory) throw std::bad_alloc();
    if (said.empty()) {
        char text[AV_ERROR_MAX_STRING_SIZE] = {};
        av_strerror(code, text, sizeof text);
        said = text;
    }
    throw Error(name, "", problem + " (" + said + ")", "try another extension or size");
}

}  // namespace stereonav
