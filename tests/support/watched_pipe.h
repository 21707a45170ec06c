// A named pipe that tells whether somebody opened it to read.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

namespace stereonav::test {

// A named pipe. Who opens it to read, and would wait for ever, is let go on, and seen.
class WatchedPipe {
public:
    explicit WatchedPipe(const std::filesystem::path& place) : mPlace(place) {
        EXPECT_EQ(mkfifo(place.c_str(), 0600), 0);
        mThread = std::thread([this] {
            while (!mEnd) {
                const int writer = open(mPlace.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
                if (writer >= 0) {  // else nobody reads
                    mOpened = true;
                    close(writer);
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
    }
    ~WatchedPipe() {
        mEnd = true;
        mThread.join();
        std::filesystem::remove(mPlace);
    }
    WatchedPipe(const WatchedPipe&) = delete;
    WatchedPipe& operator=(const WatchedPipe&) = delete;
    bool wasOpened() { return mOpened.exchange(false); }  // since it was asked last

private:
    std::filesystem::path mPlace;
    std::atomic<bool> mEnd = false, mOpened = false;
    std::thread mThread;
};

}  // namespace stereonav::test
