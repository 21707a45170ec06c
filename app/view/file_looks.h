// Descriptions of files before they are opened, read beside the window: one at a time, the latest wish first;
// another wish cancels the one before.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"

namespace stereonav {

struct FileLook {
    bool busy = false;
    std::vector<std::pair<std::string, std::string>> rows;  // label and text
    std::string problem;                                    // one line, for files that can not be opened
};

class FileLooks {
public:
    using Glance = std::function<Facts(const std::string& file, Progress& progress)>;
    static constexpr std::size_t kMostKept = 64;

    // ready: called by the thread when a description is there. glance: glanceAt(); tests use another one.
    explicit FileLooks(std::function<void()> ready, Glance glance = {});
    ~FileLooks();
    FileLooks(const FileLooks&) = delete;
    FileLooks& operator=(const FileLooks&) = delete;

    // Returns what is known of a file. What is not known is read, before earlier wishes. A file that has
    // changed since is read again.
    FileLook look(const std::filesystem::path& file);

private:
    struct Stamp {
        std::filesystem::path file;
        std::filesystem::file_time_type time{};
        std::uintmax_t bytes = 0;
        bool operator==(const Stamp&) const = default;
    };
    struct Kept {
        Stamp stamp;
        FileLook look;
    };

    static Stamp stampOf(const std::filesystem::path& file);
    void run();
    FileLook lookAt(const Stamp& stamp, Progress& progress) const;

    std::function<void()> mReady;
    Glance mGlance;
    std::mutex mMutex;
    std::condition_variable mWished;
    std::optional<Stamp> mWish, mNow;  // file to read, and file being read
    std::shared_ptr<Progress> mProgress;
    std::list<Kept> mKept;  // newest first
    bool mEnd = false;
    std::thread mThread;  // started by the first wish
};

}  // namespace stereonav
