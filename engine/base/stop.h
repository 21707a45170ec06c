// The wish of the user or the system to end the run (SIGINT, SIGTERM, SIGHUP), and what is left of a run that
// ends at once. Loops and reports of progress ask here, so that a stop comes out of them as Cancelled, which
// takes unfinished files away. What sits in a library meanwhile, or in a write that nobody reads, does not
// hold the run: after kMostStopping_ms, or sooner where it holds memory that the system takes long to take
// back, it ends where it is, its unfinished files taken away all the same.
#pragma once

namespace stereonav {

// Milliseconds from the first signal to the end, but for what is being finished.
constexpr int kMostStopping_ms = 700;
// Returns kMostStopping_ms for a run that holds `bytes` bytes of memory, less the time in which the system
// takes them back, so that the whole ends within a second. 7.9 GB took 0.26 s.
int stoppingTime_ms(double bytes);

// Makes SIGINT, SIGTERM and SIGHUP wishes to stop, unless whoever started the program had them ignored. A
// second one ends the run at once. Beyond a limit on the size of files (SIGXFSZ) writing fails.
void catchStopSignals();

bool stopWished();
// Throws Cancelled where a stop is wished, unless something is being finished.
void throwIfStopped();

// While one lives, what was done so far is being finished or kept: nothing is cut off.
class FinishingWork {
public:
    FinishingWork();
    ~FinishingWork();
    FinishingWork(const FinishingWork&) = delete;
    FinishingWork& operator=(const FinishingWork&) = delete;
};

// A file that is not complete, or a folder that holds one: taken away where the run ends at once.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const char* path);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

private:
    int mSlot;
};

// For a module (module.h), which has this code a second time: it follows the program's wish.
void* stopOfThisProgram();
void shareStop(void* program);

}  // namespace stereonav
