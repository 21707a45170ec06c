// What this process holds: tests allow so much more.
#pragma once

#include <fstream>
#include <string>

namespace stereonav::test {

// Bytes of its own memory, files and libraries left out.
inline double bytesHeld() {
    std::ifstream status("/proc/self/status");
    double kilobytes = 0;
    for (std::string word; status >> word;)
        if (word == "RssAnon:") status >> kilobytes;
    return 1024 * kilobytes;
}

}  // namespace stereonav::test
