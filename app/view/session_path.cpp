// The session's part that records flights, plays and changes them, and keeps them in files.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/view/session.h"
#include "engine/base/error.h"

namespace stereonav {

void ViewSession::toggleRecording() {
    if (mRecorder.recording()) return saveFlight();
    stopPlaying();
    mRecorder.start(mFlight->pose());
    notify("recording; z ends it");
}

void ViewSession::saveFlight() {
    try {
        takePath(mRecorder.finish());
        mOwnPath = false;
        mPathsBefore.clear();
        savePath();
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::savePath() {
    try {
        std::filesystem::path file;
        int number = 1;
        do file = mFolder / fmt::format("flight_{:04}.gltf", number++);
        while (std::filesystem::exists(file));
        writePath(file, mPath);
        notify(fmt::format("flight of {:.1f} s recorded in {}; Z plays it", mPath.duration(), file.string()));
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::togglePlaying() {
    if (mPlaying) return stopPlaying();
    if (mRecorder.recording()) saveFlight();
    if (mPath.samples().size() < 2) return notify("there is no flight to play; z records one");
    mGoal.reset();
    mPlaying = true;
    mPlayTime = 0;
    mPlayed = mPath.at(mPath.startTime());
    notify(fmt::format("playing {:.1f} s", mPath.duration()));
}

void ViewSession::stopPlaying() {
    if (!mPlaying) return;
    mPlaying = false;
    mFlight->setPose(mPlayed);
    notify(fmt::format("played {:.1f} s", mPlayTime));
}

void ViewSession::stepPlaying(double dt) {
    mPlayTime = std::min(mPlayTime + dt, mPath.duration());
    mPlayed = mPath.at(mPath.startTime() + mPlayTime);
    if (mPlayTime >= mPath.duration()) stopPlaying();
}

void ViewSession::editPath(const std::function<RecordedPath(const RecordedPath&)>& edit) {
    constexpr std::size_t kKept = 50;
    stopPlaying();
    try {
        RecordedPath edited = edit(mPath);
        mPathsBefore.push_back({mPath, mOwnPath});
        takePath(std::move(edited));
        if (mPathsBefore.size() > kKept) mPathsBefore.erase(mPathsBefore.begin());
        mOwnPath = false;
        notify(fmt::format("a flight of {:.1f} s", mPath.duration()));
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::takePath(RecordedPath path) {
    mPath = std::move(path);
    ++mPathVersion;
}

void ViewSession::setPath(RecordedPath path) {
    stopPlaying();
    takePath(std::move(path));
    mOwnPath = false;
}

void ViewSession::undoPath() {
    if (mPathsBefore.empty()) return notify("the path was not changed");
    stopPlaying();
    PathBefore before = std::move(mPathsBefore.back());
    mPathsBefore.pop_back();
    mOwnPath = before.own;
    takePath(before.own ? shown().path : std::move(before.path));
    notify(mPath.samples().empty() ? "no flight" : fmt::format("a flight of {:.1f} s", mPath.duration()));
}

}  // namespace stereonav
