// A helper for helper_program_test.cpp: does as it is told.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "engine/base/helper_program.h"

namespace {

std::string obey(std::string_view request) {
    constexpr std::uint64_t kMegabyte = 1 << 20;
    const std::string word(request.substr(0, request.find(' ')));
    if (word == "echo") return std::string(request.substr(request.find(' ') + 1));
    if (word == "throw") throw std::runtime_error("expected a sound request");
    if (word == "crash") std::raise(SIGSEGV);
    if (word == "leave") _exit(7);
    if (word == "print") {
        const std::string text = "to both streams\n";
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
            if (write(stream, text.data(), text.size()) < 0) return "could not";
        return "printed";
    }
    if (word == "spin") {
        stereonav::limitThisProcess(512 * kMegabyte, 1);
        for (std::atomic<int> n = 0;;) ++n;
    }
    if (word == "take") {
        stereonav::limitThisProcess(64 * kMegabyte, 60);
        try {
            const std::vector<char> much(512 * kMegabyte, 1);
            return "taken";
        } catch (const std::bad_alloc&) {
            return "refused";
        }
    }
    return "unknown word";
}

}  // namespace

int main() {
    return stereonav::serveRequests(obey);
}
