// Keyframes that the user edits on the map, and the flight through them.
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

    // Ends the editing, for another session.
    void end() { mEdit.start({}); }
    // Moves the keyframes with ground whose heights changed; the session's path was moved with it.
    void raise(const RaisedGround& raised, const ViewSession& session);
    // Lets the flight follow the keyframes, except while one is dragged; to be called each turn. The editing
    // ends where another flight takes the place of this one.
    void follow(ViewSession& session, Notices& notices);

private:
    KeyframeEdit mEdit;
    long long mSeen = 0, mPath = 0;  // versions of the keyframes, and of the path made of them
    bool mFlown = false;             // whether the session's path was made of them
};

}  // namespace stereonav
