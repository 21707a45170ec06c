// A command of the program that runs in a process of its own beside the window: a movie, a bake. It only
// takes processor time from the window's frames, and ending it has the effect of stopping the command
// (docs/using.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/module.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

class Job {
public:
    // words: the arguments of the program; program: its file. Throws Error where no process can be made.
    Job(std::string what, const std::vector<std::string>& words,
        const std::filesystem::path& program = programFile());
    ~Job();  // stops the process and waits until it has ended
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    // Reads its output, and whether it has ended; to be called now and then.
    void look();
    void cancel();

    const std::string& what() const { return mWhat; }
    bool running() const { return mProcess > 0; }
    int processId() const { return mProcess; }
    // Returns whether it was cancelled. Work that was complete before the wish does not count.
    bool cancelled() const { return mCancelled && (running() || mStatus != 0); }
    bool failed() const { return !running() && mStatus != 0 && !mCancelled; }
    double fraction() const { return mFraction; }                  // 0 to 1
    const std::string& progress() const { return mProgress; }      // text of its progress
    const std::string& lastLine() const { return mLast; }          // last line of its other output
    double seconds() const { return mWatch.elapsed_ms() / 1000; }  // time since it began

private:
    void read();
    void take(const std::string& line);

    std::string mWhat, mProgress, mLast, mRest;
    int mProcess = 0, mPipe = -1, mStatus = 0;
    double mFraction = 0;
    bool mCancelled = false;
    Stopwatch mWatch;
};

// Returns the file in the cache for the light that a job with these words bakes.
std::filesystem::path placeOfBake(const std::vector<std::string>& words);

// A file that only a job reads: removed with this object, and where the run ends at once.
class JobFile {
public:
    explicit JobFile(std::filesystem::path path);
    ~JobFile();
    JobFile(const JobFile&) = delete;
    JobFile& operator=(const JobFile&) = delete;

    const std::filesystem::path& path() const { return mPath; }

private:
    std::filesystem::path mPath;
    UnfinishedFile mUnfinished;
};

// Reads the share and the text of a line "[===>   ]  52 % words" or " 52 % words"; returns false for other
// lines.
bool progressOf(const std::string& line, double& fraction, std::string& words);

}  // namespace stereonav
