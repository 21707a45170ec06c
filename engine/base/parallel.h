// Parallel loops: the only door to the task library. Results of a loop must not depend on the
// thread count; callers write disjoint outputs per index.
#pragma once

#include <atomic>
#include <functional>

namespace stereonav {

// How indices are assigned to threads; the names are those of Wan et al. 2004, section 3.
enum class Schedule {
    Dynamic,      // work stealing, smallest pieces: the default
    Interleaved,  // static: thread k takes k, k + n, k + 2n, ...
    Contiguous,   // static: thread k takes one run of indices
};

// Sets the number of threads that loops use, 1 or more. Called once at start-up (or by a measuring command).
void setThreadCount(int threads);
int threadCount();

// Calls body(i) for every i in [0, count). Rethrows the first exception that a body throws. In the program's
// first thread it throws Cancelled once a stop is wished (stop.h).
void parallelFor(int count, const std::function<void(int)>& body, Schedule schedule = Schedule::Dynamic);

// Lets loops that this thread starts from now on throw Cancelled once the flag is set, until it is called
// with null: for work whose result is no longer wanted. The flag must outlive those loops.
void interruptLoopsBy(const std::atomic<bool>* stop);

// For a module (module.h), which has its own copy of this code: it takes the program's threads before its
// first loop.
void* loopsOfThisProgram();
void shareLoops(void* program);

}  // namespace stereonav
