// The session's part that flies by itself: to a place, along a way, round to look back.
#include <fmt/format.h>

#include <utility>

#include "app/view/session.h"
#include "engine/base/error.h"

namespace stereonav {

void ViewSession::startGoal(const std::function<FlightTo(const Flight&)>& goal) {
    stopPlaying();
    mResting = false;
    mLooked = true;
    try {
        mGoal = goal(*mFlight);
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::flyTo(const Pose& pose) {
    startGoal([&](const Flight& flight) { return FlightTo::pose(flight, pose); });
}

void ViewSession::flyAlong(double along) {
    startGoal([&](const Flight& flight) { return FlightTo::along(flight, along); });
}

void ViewSession::stepGoal(double dt) {
    const FlightTo::State state = mGoal->step(*mFlight, dt);
    if (state == FlightTo::State::Flying) return;
    mGoal.reset();
    mLooked = true;
    if (state == FlightTo::State::Blocked) notify("as near as there is room");
}

void ViewSession::turnRound() {
    mResting = false;
    if (mFlight->turnRound())
        notify(mFlight->goesBack() ? "flying back: forward goes to the start of the line"
                                   : "forward goes to the end of the line");
    else
        notify("turning round is of a guided flight: F");
}

void ViewSession::editPath(const std::function<RecordedPath(const RecordedPath&)>& edit) {
    constexpr std::size_t kKept = 50;
    stopPlaying();
    try {
        RecordedPath edited = edit(mPath);
        mPathsBefore.push_back(mPath);
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
    takePath(std::move(mPathsBefore.back()));
    mPathsBefore.pop_back();
    notify(mPath.samples().empty() ? "no flight" : fmt::format("a flight of {:.1f} s", mPath.duration()));
}

}  // namespace stereonav
