// A part of the program that runs as a process of its own, lib/stereonav/stereonav_<name>. What a library
// does over damaged data (it ends, prints, takes memory or time without end) stays in there.
//
//   program    HelperProgram helper("gdcm", "to unpack DICOM pictures");  helper.ask(request, mostBytes)
//   helper     int main() { return serveRequests([](std::string_view request) { ... }); }
//
// Both are of one build and on one machine, so that requests and answers may be structures as they lie in
// memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace stereonav {

struct HelperAnswer {
    enum class Kind {
        Given,    // text: the answer's bytes
        Refused,  // text: what was thrown, one line
        Ended,    // text: how the helper ended over it, "by Segmentation fault"
    };
    Kind kind = Kind::Ended;
    std::string text;
};

class HelperProgram {
public:
    // Starts it. purpose completes "it is needed ...". Throws Error naming the file where it is missing, can
    // not run or is of another build.
    HelperProgram(const std::string& name, const std::string& purpose);
    ~HelperProgram();  // ends it, whatever it does
    HelperProgram(const HelperProgram&) = delete;
    HelperProgram& operator=(const HelperProgram&) = delete;

    // One request at a time. An answer of more than mostBytes counts as Ended. After Ended nothing more can
    // be asked. A wish to stop (stop.h) is heard within a tenth of a second and throws Cancelled.
    HelperAnswer ask(std::string_view request, std::uint64_t mostBytes);

    int processId() const { return mProcess; }

private:
    HelperProgram(const std::filesystem::path& file, const std::string& purpose, int);  // without a word
    bool send(const void* bytes, std::size_t count);
    bool receive(void* bytes, std::size_t count);
    std::string waitForEnd();

    int mProcess = -1, mSocket = -1;
};

// --- the helper's side

// Answers until the program closes its end; what `answer` throws is told to the program. Returns main's
// status.
int serveRequests(const std::function<std::string(std::string_view request)>& answer);

// From now on at most so much memory (bytes beyond what is taken) and processor time: beyond it allocations
// fail, and the system ends this process. Sanitized builds take memory as they like.
void limitThisProcess(std::uint64_t memory, int seconds);

}  // namespace stereonav
