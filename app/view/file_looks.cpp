#include "app/view/file_looks.h"

#include <algorithm>
#include <chrono>

#include "app/scene/file_glance.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// Delay before a file is read, so that files that the pointer only passes are not.
constexpr std::chrono::milliseconds kPatience{120};

}  // namespace

FileLooks::FileLooks(std::function<void()> ready, Glance glance)
    : mReady(std::move(ready)), mGlance(glance ? std::move(glance) : Glance(glanceAt)) {}

FileLooks::~FileLooks() {
    {
        const std::lock_guard lock(mMutex);
        mEnd = true;
        if (mProgress) mProgress->cancel();
    }
    mWished.notify_all();
    if (mThread.joinable()) mThread.join();
}

FileLooks::Stamp FileLooks::stampOf(const std::filesystem::path& file) {
    std::error_code code;
    Stamp stamp{file, std::filesystem::last_write_time(file, code), 0};
    if (code) stamp.time = {};
    if (const std::uintmax_t bytes = std::filesystem::file_size(file, code); !code) stamp.bytes = bytes;
    return stamp;
}

FileLook FileLooks::look(const std::filesystem::path& file) {
    const Stamp stamp = stampOf(file);
    const std::lock_guard lock(mMutex);
    const auto kept =
        std::find_if(mKept.begin(), mKept.end(), [&](const Kept& known) { return known.stamp == stamp; });
    if (kept != mKept.end()) return kept->look;
    FileLook busy;
    busy.busy = true;
    if (mWish == stamp || (!mWish && mNow == stamp)) return busy;
    mWish = stamp;
    if (mProgress) mProgress->cancel();
    if (!mThread.joinable()) mThread = std::thread([this] { run(); });
    mWished.notify_all();
    return busy;
}

void FileLooks::run() {
    std::unique_lock lock(mMutex);
    while (true) {
        mWished.wait(lock, [this] { return mEnd || mWish; });
        // Waits until the wish has not changed for a moment.
        for (auto wish = mWish; !mEnd; wish = mWish) {
            mWished.wait_for(lock, kPatience, [&] { return mEnd || mWish != wish; });
            if (mWish == wish) break;
        }
        if (mEnd) return;
        mNow = std::exchange(mWish, std::nullopt);
        mProgress = std::make_shared<Progress>();
        const auto progress = mProgress;
        const Stamp stamp = *mNow;
        lock.unlock();
        std::optional<FileLook> look;
        try {
            look = lookAt(stamp, *progress);
        } catch (const Cancelled&) {
            // Another file is wished for.
        }
        lock.lock();
        mProgress = nullptr;
        mNow.reset();
        if (!look) continue;
        mKept.push_front({stamp, std::move(*look)});
        if (mKept.size() > kMostKept) mKept.pop_back();
        lock.unlock();
        if (mReady) mReady();
        lock.lock();
    }
}

FileLook FileLooks::lookAt(const Stamp& stamp, Progress& progress) const {
    FileLook look;
    try {
        look.rows = rowsOf(mGlance(stamp.file.string(), progress));
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        look.problem = error.what();
    }
    return look;
}

}  // namespace stereonav
