// How much memory this process held at most since a moment (Linux: VmHWM of /proc/self/status, which writing
// 5 to /proc/self/clear_refs sets back to what is held now).
#pragma once

#include <cstdio>
#include <fstream>
#include <string>

namespace stereonav {

class PeakMemory {
public:
    PeakMemory() {
        std::ofstream("/proc/self/clear_refs") << "5";
        mBefore = megabytesOf("VmRSS:");
    }
    // Returns the peak above what was held at the beginning; megabytes of 10^6 bytes.
    double more() const { return megabytesOf("VmHWM:") - mBefore; }

private:
    static double megabytesOf(const std::string& field) {
        std::ifstream in("/proc/self/status");
        for (std::string word; in >> word;)
            if (word == field) {
                double kibibytes = 0;
                in >> kibibytes;
                return kibibytes * 1024e-6;
            }
        return 0;
    }
    double mBefore = 0;
};

}  // namespace stereonav
