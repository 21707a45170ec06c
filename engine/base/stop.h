// The wish of the user or the system to end the run (SIGINT, SIGTERM, SIGHUP). Loops and reports of progress
// test it and then throw Cancelled, which removes unfinished files. A run that hangs in a library, or in a
// write that nobody reads, is ended where it is after kMostStopping_ms, or sooner where it holds so much
// memory that the system needs time to take it back; its unfinished files are removed as well.
#pragma once

namespace stereonav {

// Milliseconds from the first signal to the end of the run, except for work in FinishingWork.
constexpr int kMostStopping_ms = 700;
// Returns kMostStopping_ms for a run that holds `bytes` bytes of memory, less the time in which the system
// takes them back, so that the whole ends within a second. 7.9 GB took 0.26 s.
int stoppingTime_ms(double bytes);

// Makes SIGINT, SIGTERM and SIGHUP wishes to stop, except those that were ignored when the program was
// started. A second signal ends the run at once. Writing beyond a limit on file sizes (SIGXFSZ) fails with an
// error.
void catchStopSignals();

bool stopWished();
// Throws Cancelled where a stop is wished, except during FinishingWork.
void throwIfStopped();

// While such an object lives, finished work is being completed or saved: a stop does not interrupt it.
class FinishingWork {
public:
    FinishingWork();
    ~FinishingWork();
    FinishingWork(const FinishingWork&) = delete;
    FinishingWork& operator=(const FinishingWork&) = delete;
};

// A file that is not complete, or a folder that holds one: it is removed where the run ends at once.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const char* path);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

private:
    int mSlot;
};

// For a module (module.h), which has its own copy of this code: it follows the program's wish.
void* stopOfThisProgram();
void shareStop(void* program);

}  // namespace stereonav
