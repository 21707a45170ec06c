// Keyframes that a person moves about on the map, and the flight that follows them.
#pragma once

#include "app/view/keyframe_edit.h"
#include "app/view/raised_ground.h"
#include "app/view/session.h"

namespace stereonav {

class Notices;

class FlownKeyframes {
public:
    KeyframeEdit& edit() { return mEdit; }
    const KeyframeEdit& edit() const { return mEdit; }

    // Another session begins.
    void end() { mEdit.start({}); }
    // The ground that they are over was raised, and the session's path with it.
    void raise(const RaisedGround& raised, const ViewSession& session);
    // Each turn: the flight follows them, but not while one is dragged. Where another flight takes its place
    // they end.
    void follow(ViewSession& session, Notices& notices);

private:
    KeyframeEdit mEdit;
    long long mSeen = 0, mPath = 0;  // versions: of the keyframes, and of the path beside them
    bool mFlown = false;             // that path is theirs
};

}  // namespace stereonav
