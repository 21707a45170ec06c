// A command of the program's own that runs beside the window, in a process of its own: a movie, a bake. The
// window's frames lose processor time to it and nothing else, and ending it leaves what the command leaves
// when it is stopped (docs/using.md).
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
    // words: after the program's name; program: its file. Throws Error where no process can be made.
    Job(std::string what, const std::vector<std::string>& words,
        const std::filesystem::path& program = programFile());
    ~Job();  // stops it, and waits until it has ended
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    // Takes what it has told since, and whether it has ended; to be called now and then.
    void look();
    void cancel();

    const std::string& what() const { return mWhat; }
    bool running() const { return mProcess > 0; }
    int processId() const { return mProcess; }
    // What was done before the wish to end came is not cancelled.
    bool cancelled() const { return mCancelled && (running() || mStatus != 0); }
    bool failed() const { return !running() && mStatus != 0 && !mCancelled; }
    double fraction() const { return mFraction; }                  // 0 to 1
    const std::string& progress() const { return mProgress; }      // its words on that
    const std::string& lastLine() const { return mLast; }          // of all else that it told
    double seconds() const { return mWatch.elapsed_ms() / 1000; }  // since it began

private:
    void read();
    void take(const std::string& line);

    std::string mWhat, mProgress, mLast, mRest;
    int mProcess = 0, mPipe = -1, mStatus = 0;
    double mFraction = 0;
    bool mCancelled = false;
    Stopwatch mWatch;
};

// Where light is kept that a job with these words bakes: in the cache, a file for each bake.
std::filesystem::path placeOfBake(const std::vector<std::string>& words);

// A file that a job reads and nobody else wants: taken away with this, and where the run ends at once.
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

// The share and the words of a line "[===>   ]  52 % words" or " 52 % words"; false for any other.
bool progressOf(const std::string& line, double& fraction, std::string& words);

}  // namespace stereonav
