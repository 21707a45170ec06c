// What the running program has started and holds, as the system tells it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/facts.h"

namespace stereonav {

// Called first in main: the clock of the start runs from there.
void noteStart();

struct ProcessFacts {
    double beforeMain_ms = 0;            // processor time until noteStart(): loading libraries
    double ready_ms = 0;                 // from there until the scene could be cast
    std::size_t heapBytes = 0;           // that malloc has given out; volumes (LazyArray) are not among it
    int threads = 0;                     // that run, the first included
    std::size_t peakBytes = 0;           // resident at most, libraries included
    std::vector<std::string> libraries;  // files, itself left out
    std::vector<std::string> modules;    // names of its own modules among them
};
void takeWhenReady(ProcessFacts& facts);  // ready_ms, heapBytes
void takeAtEnd(ProcessFacts& facts);      // the rest

Facts factsOf(const ProcessFacts& process);

}  // namespace stereonav
