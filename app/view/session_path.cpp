// The session's part that records flights, plays and changes them, and keeps them in files.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/view/session.h"
#include "engine/base/error.h"

namespace stereonav {

void ViewSession::toggleRecording() {
    if (mRecorder->recording()) return saveFlight();
    stopPlaying();
    mRecorder->start(mFlight->pose());
    notify("recording; z ends it");
}

void ViewSession::saveFlight() {
    try {
        RecordedPath flown = mRecorder->finish();
        if (mPathIs == PathIs::Unsaved) savePath();  // the recording takes its place
        takePath(std::move(flown), PathIs::Unsaved);
        mOwnPath = false;
        mPathsBefore.clear();
        writtenTo([this] { return mRecorder->keepRecorded(mPath); });
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::savePath() {
    writtenTo([this] { return mRecorder->keep(mPath); });
}

void ViewSession::writtenTo(const std::function<std::filesystem::path()>& write) {
    try {
        const std::filesystem::path file = write();
        mPathIs = PathIs::InFile;
        notify(fmt::format("flight of {:.1f} s recorded in {}; Z plays it", mPath.duration(), file.string()));
    } catch (const Error& error) {
        notify(error.what());
    }
}

std::string ViewSession::keepWork() {
    if (recording())
        saveFlight();
    else if (mPathIs == PathIs::Unsaved && mPath.samples().size() > 1)
        savePath();
    else
        return "";
    return mNotice;
}

void ViewSession::togglePlaying() {
    if (mPlaying) return stopPlaying();
    if (mRecorder->recording()) saveFlight();
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
    putPath(edit, PathIs::Unsaved);
}

void ViewSession::openPath(RecordedPath path) {
    putPath([&](const RecordedPath&) { return std::move(path); }, PathIs::InFile);
}

void ViewSession::putPath(const std::function<RecordedPath(const RecordedPath&)>& edit, PathIs where) {
    stopPlaying();
    try {
        RecordedPath edited = edit(mPath);
        mPathsBefore.push_back({mPath, mOwnPath, mPathIs});
        takePath(std::move(edited), where);
        dropOldestPaths();
        mOwnPath = false;
        notify(fmt::format("a flight of {:.1f} s", mPath.duration()));
    } catch (const Error& error) {
        notify(error.what());
    }
}

// The steps back are bounded in what they hold: a recording of an hour has 14 MB.
void ViewSession::dropOldestPaths() {
    constexpr std::size_t kKept = 50, kKeptPlaces = 1'000'000;
    std::size_t steps = 0, places = 0;
    for (auto step = mPathsBefore.rbegin(); step != mPathsBefore.rend(); ++step, ++steps) {
        places += step->path.samples().size();
        if (steps == kKept || (steps > 0 && places > kKeptPlaces)) break;
    }
    mPathsBefore.erase(mPathsBefore.begin(), mPathsBefore.end() - static_cast<std::ptrdiff_t>(steps));
}

void ViewSession::takePath(RecordedPath path, PathIs where) {
    mPath = std::move(path);
    mPathIs = where;
    ++mPathVersion;
}

void ViewSession::setPath(RecordedPath path) {
    stopPlaying();
    takePath(std::move(path), PathIs::Unsaved);
    mOwnPath = false;
}

void ViewSession::undoPath() {
    if (mPathsBefore.empty()) return notify("the path was not changed");
    stopPlaying();
    PathBefore before = std::move(mPathsBefore.back());
    mPathsBefore.pop_back();
    mOwnPath = before.own;
    takePath(before.own ? shown().path : std::move(before.path), before.where);
    notify(mPath.samples().empty() ? "no flight" : fmt::format("a flight of {:.1f} s", mPath.duration()));
}

}  // namespace stereonav
