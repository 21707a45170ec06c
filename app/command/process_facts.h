// Facts of the running program from the system: its libraries, threads and memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/facts.h"

namespace stereonav {

// Has to be called first in main: the time of the start is counted from there.
void noteStart();

struct ProcessFacts {
    double beforeMain_ms = 0;            // processor time until noteStart(): loading libraries
    double ready_ms = 0;                 // time from there until the scene could be shown
    std::size_t heapBytes = 0;           // memory given out by malloc; volumes (LazyArray) are not included
    int threads = 0;                     // running threads, including the first
    std::size_t peakBytes = 0;           // largest resident memory, including libraries
    std::vector<std::string> libraries;  // library files, without the program itself
    std::vector<std::string> modules;    // names of the program's own modules among them
};
void takeWhenReady(ProcessFacts& facts);  // sets ready_ms and heapBytes
void takeAtEnd(ProcessFacts& facts);      // sets the other members

Facts factsOf(const ProcessFacts& process);

}  // namespace stereonav
