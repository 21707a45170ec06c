#include "colon/gdcm/quiet_thread.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <mutex>
#include <streambuf>

namespace stereonav {
namespace {

thread_local bool quiet = false;

// As much as the descriptor takes, or nothing of it from a quiet thread.
ssize_t passOn(void*, const char* text, size_t bytes) {
    for (size_t done = 0; !quiet && done < bytes;) {
        const ssize_t count = write(STDERR_FILENO, text + done, bytes - done);
        if (count <= 0) break;
        done += static_cast<size_t>(count);
    }
    return static_cast<ssize_t>(bytes);
}

class QuietBuffer : public std::streambuf {
    int overflow(int c) override {
        const char text = static_cast<char>(c);
        if (c != traits_type::eof()) passOn(nullptr, &text, 1);
        return traits_type::not_eof(c);
    }
    std::streamsize xsputn(const char* text, std::streamsize count) override {
        return passOn(nullptr, text, static_cast<size_t>(count));
    }
};

std::mutex swapping;
int quietThreads = 0;
FILE* usualStream = nullptr;
std::streambuf* usualBuffer = nullptr;

// Made once and never closed: a thread may be about to print.
FILE* filteredStream() {
    static FILE* const stream = [] {
        cookie_io_functions_t functions{};
        functions.write = passOn;
        FILE* made = fopencookie(nullptr, "w", functions);
        if (made) setvbuf(made, nullptr, _IONBF, 0);
        return made;
    }();
    return stream;
}

}  // namespace

QuietThread::QuietThread() {
    static QuietBuffer buffer;
    quiet = true;
    const std::lock_guard lock(swapping);
    if (quietThreads++ > 0) return;
    usualStream = stderr;
    if (FILE* filtered = filteredStream()) stderr = filtered;
    usualBuffer = std::cerr.rdbuf(&buffer);
}

QuietThread::~QuietThread() {
    quiet = false;
    const std::lock_guard lock(swapping);
    if (--quietThreads > 0) return;
    stderr = usualStream;
    std::cerr.rdbuf(usualBuffer);
}

}  // namespace stereonav
