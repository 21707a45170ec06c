// A part of the program that runs in a process of its own, lib/stereonav/stereonav_<name>. A library that is
// given damaged or malicious data may crash, print, take memory or time without end, or run foreign code; in
// a helper that does not reach the program.
//
//   program    HelperProgram helper("gdcm", "to unpack DICOM pictures");  helper.ask(request, limits)
//   helper     int main() { return serveRequests([](std::string_view request) { ... }); }
//
// The helper's side is engine/helper/serve_requests.h. Both sides are of one build and run on one machine, so
// that requests and answers may be structures as they lie in memory; each field of an answer is checked all
// the same.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/helper_socket.h"

namespace stereonav {

// Limits of one request. In sanitized builds the memory limit does not hold: they take memory as they like.
struct HelperLimits {
    std::uint64_t answer = 0;                                 // bytes; a longer one counts as Ended
    std::uint64_t memory = std::uint64_t{1} << 30;            // bytes, beyond those that it has
    std::chrono::seconds work{60};                            // processor time
    std::chrono::milliseconds wait{std::chrono::minutes(5)};  // by the clock
};
// Returns the limits for a picture of `pixels` pixels in a file of `packed` bytes: far more than an undamaged
// one needs.
HelperLimits limitsForPicture(std::uint64_t pixels, std::uint64_t packed, std::uint64_t answer);
// Sets the longest time that any answer is waited for from now on, whatever HelperLimits say; for tests.
void waitForHelpersAtMost(std::chrono::milliseconds longest);

class HelperProgram {
public:
    // Starts the helper. purpose completes "it is needed ...". Throws Error naming the file where it is
    // missing, can not run, does not report within that time that it runs, or is of another build.
    HelperProgram(const std::string& name, const std::string& purpose,
                  std::chrono::milliseconds startWithin = std::chrono::minutes(5));
    ~HelperProgram();  // ends the helper, whatever it is doing
    HelperProgram(const HelperProgram&) = delete;
    HelperProgram& operator=(const HelperProgram&) = delete;

    // Asks one request at a time. A helper that exceeds a limit is ended; after HelperAnswer::Ended no more
    // requests can be asked. A wish to stop (stop.h) is noticed within a tenth of a second and throws
    // Cancelled.
    HelperAnswer ask(std::string_view request, const HelperLimits& limits);

    int processId() const { return mProcess; }

private:
    HelperProgram(const std::filesystem::path& file, const std::string& purpose, int);  // without a word
    void limit(const HelperLimits& limits) const;
    std::string end();
    std::string waitForEnd(int looks = 100);

    int mProcess = -1;
    std::optional<HelperSocket> mSocket;
};

}  // namespace stereonav
