// Memory that is taken in many parts, each too small to check for itself.
#pragma once

#include <string>
#include <utility>

#include "engine/base/memory.h"

namespace stereonav {

class MemoryParts {
public:
    // What is asked for, and what to do, in the words of checkMemory().
    MemoryParts(std::string what, std::string advice) : mWhat(std::move(what)), mAdvice(std::move(advice)) {}

    // Notes that a part is about to be taken. Throws Error where it and the parts that were not checked yet
    // are more than the available memory.
    void take(double bytes) {
        mUnasked += bytes;
        if (mUnasked >= kAskEach) checkMemory(mWhat, std::exchange(mUnasked, 0), mAdvice);
    }

private:
    static constexpr double kAskEach = 4e6;  // bytes after which memory is checked again

    std::string mWhat, mAdvice;
    double mUnasked = 0;  // bytes taken since the last check
};

}  // namespace stereonav
