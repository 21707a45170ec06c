// Parallel loops: the only door to the task library. Results of a loop must not depend on the
// thread count; callers write disjoint outputs per index.
#pragma once

#include <atomic>
#include <functional>

namespace stereonav {

// How indices are dealt to threads; the names are those of Wan et al. 2004, section 3.
enum class Schedule {
    Dynamic,      // work stealing, smallest pieces: the default
    Interleaved,  // static: thread k takes k, k + n, k + 2n, ...
    Contiguous,   // static: thread k takes one run of indices
};

// Threads that loops use, 1 or more. Set once at start-up (or by a measuring command).
void setThreadCount(int threads);
int threadCount();

// Calls body(i) for every i in [0, count). The first exception thrown by a body is rethrown here. Started by
// the program's first thread it throws Cancelled once a stop is wished (stop.h).
void parallelFor(int count, const std::function<void(int)>& body, Schedule schedule = Schedule::Dynamic);

// Lets loops that this thread starts from now on throw Cancelled once the flag is set, until null is given:
// for work that is not worth its time any more. The flag outlives them.
void interruptLoopsBy(const std::atomic<bool>* stop);

// For a module (module.h), which has this code a second time: it takes over the program's threads before its
// first loop.
void* loopsOfThisProgram();
void shareLoops(void* program);

}  // namespace stereonav
