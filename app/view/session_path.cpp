#include "app/view/session_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.h"

namespace stereonav {

void SessionPath::toggleRecording() {
    if (mRecorder.recording()) return saveFlight();
    stop();
    mRecorder.start(mFlight->pose());
    mNotice.say("recording; z ends it");
}

void SessionPath::saveFlight() {
    try {
        RecordedPath flown = mRecorder.finish();
        if (mIs == Is::Unsaved) save();  // the recording takes its place
        take(std::move(flown), Is::Unsaved);
        mOwn = false;
        mBefore.clear();
        writtenTo([this] { return mRecorder.keepRecorded(mPath); });
    } catch (const Error& error) {
        mNotice.say(error.what());
    }
}

void SessionPath::save() {
    writtenTo([this] { return mRecorder.keep(mPath); });
}

void SessionPath::writtenTo(const std::function<std::filesystem::path()>& write) {
    try {
        const std::filesystem::path file = write();
        mIs = Is::InFile;
        mNotice.say(
            fmt::format("flight of {:.1f} s recorded in {}; Z plays it", mPath.duration(), file.string()));
    } catch (const Error& error) {
        mNotice.say(error.what());
    }
}

std::string SessionPath::keepWork() {
    if (mRecorder.recording())
        saveFlight();
    else if (mIs == Is::Unsaved && mPath.samples().size() > 1)
        save();
    else
        return "";
    return mNotice.text();
}

void SessionPath::togglePlaying() {
    if (mPlaying) return stop();
    if (mRecorder.recording()) saveFlight();
    if (mPath.samples().size() < 2) return mNotice.say("there is no flight to play; z records one");
    mPlaying = true;
    mTime = 0;
    mPlayed = mPath.at(mPath.startTime());
    mNotice.say(fmt::format("playing {:.1f} s", mPath.duration()));
}

void SessionPath::stop() {
    if (!mPlaying) return;
    mPlaying = false;
    mFlight->setPose(mPlayed);
    mNotice.say(fmt::format("played {:.1f} s", mTime));
}

void SessionPath::step(double dt) {
    if (!mPlaying) return;
    mTime = std::min(mTime + dt, mPath.duration());
    mPlayed = mPath.at(mPath.startTime() + mTime);
    if (mTime >= mPath.duration()) stop();
}

void SessionPath::edit(const std::function<RecordedPath(const RecordedPath&)>& edit) {
    put(edit, Is::Unsaved);
}

void SessionPath::open(RecordedPath path) {
    if (mIs == Is::Unsaved && mPath.samples().size() > 1) save();  // the opened one takes its place
    put([&](const RecordedPath&) { return std::move(path); }, Is::InFile);
}

void SessionPath::put(const std::function<RecordedPath(const RecordedPath&)>& edit, Is where) {
    stop();
    try {
        RecordedPath edited = edit(mPath);
        mBefore.push_back({mPath, mOwn, mIs});
        take(std::move(edited), where);
        dropOldest();
        mOwn = false;
        mNotice.say(fmt::format("a flight of {:.1f} s", mPath.duration()));
    } catch (const Error& error) {
        mNotice.say(error.what());
    }
}

// Drops old steps where they hold too much: a recording of an hour has 14 MB.
void SessionPath::dropOldest() {
    constexpr std::size_t kKept = 50, kKeptPlaces = 1'000'000;
    std::size_t steps = 0, places = 0;
    for (auto step = mBefore.rbegin(); step != mBefore.rend(); ++step, ++steps) {
        places += step->path.samples().size();
        if (steps == kKept || (steps > 0 && places > kKeptPlaces)) break;
    }
    mBefore.erase(mBefore.begin(), mBefore.end() - static_cast<std::ptrdiff_t>(steps));
}

void SessionPath::take(RecordedPath path, Is where) {
    mPath = std::move(path);
    mIs = where;
    ++mVersion;
}

void SessionPath::set(RecordedPath path) {
    stop();
    take(std::move(path), Is::Unsaved);
    mOwn = false;
}

void SessionPath::undo() {
    if (mBefore.empty()) return mNotice.say("the path was not changed");
    stop();
    Before before = std::move(mBefore.back());
    mBefore.pop_back();
    mOwn = before.own;
    take(before.own ? mScene->scene->path : std::move(before.path), before.where);
    mNotice.say(mPath.samples().empty() ? "no flight"
                                        : fmt::format("a flight of {:.1f} s", mPath.duration()));
}

void SessionPath::replaceScene(const std::optional<RaisedGround>& raised) {
    if (mOwn) return take(mScene->scene->path, Is::InFile);
    if (!raised) return;
    stop();
    take(raised->moved(mPath), mIs);
    for (Before& step : mBefore) step.path = raised->moved(step.path);
}

Pose SessionPath::ahead(double seconds) const {
    return mPath.at(mPath.startTime() + std::min(mTime + seconds, mPath.duration()));
}

}  // namespace stereonav
