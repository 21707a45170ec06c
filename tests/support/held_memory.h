// Memory of this process, to which tests add what they allow.
#pragma once

#include <fstream>
#include <string>

namespace stereonav::test {

// Returns the bytes of its own memory, without files and libraries.
inline double bytesHeld() {
    std::ifstream status("/proc/self/status");
    double kilobytes = 0;
    for (std::string word; status >> word;)
        if (word == "RssAnon:") status >> kilobytes;
    return 1024 * kilobytes;
}

}  // namespace stereonav::test
