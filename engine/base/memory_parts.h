// Memory that is taken in many parts, of which none is worth asking for.
#pragma once

#include <string>
#include <utility>

#include "engine/base/memory.h"

namespace stereonav {

class MemoryParts {
public:
    // What is asked for, and what to do, in the words of checkMemory().
    MemoryParts(std::string what, std::string advice) : mWhat(std::move(what)), mAdvice(std::move(advice)) {}

    // A part is about to be taken. Throws Error where it and those that were not asked for are more than
    // there is.
    void take(double bytes) {
        mUnasked += bytes;
        if (mUnasked >= kAskEach) checkMemory(mWhat, std::exchange(mUnasked, 0), mAdvice);
    }

private:
    static constexpr double kAskEach = 4e6;  // bytes

    std::string mWhat, mAdvice;
    double mUnasked = 0;  // bytes taken since memory was last asked for
};

}  // namespace stereonav
