#include "app/view/flown_keyframes.h"

#include <utility>

#include "app/view/notices.h"

namespace stereonav {

void FlownKeyframes::raise(const RaisedGround& raised, const ViewSession& session) {
    if (!mEdit.any()) return;
    mEdit.start(raised.moved(mEdit.keys()));
    mPath = session.paths().version();
}

void FlownKeyframes::follow(ViewSession& session, Notices& notices) {
    if (mEdit.any() && mEdit.version() == mSeen && session.paths().version() != mPath) mEdit.start({});
    if (!mEdit.any() && !mEdit.canUndo()) mFlown = false;
    if (mEdit.version() == mSeen || mEdit.dragging()) return;
    mSeen = mEdit.version();
    if (mEdit.keys().size() > 1)
        notices.tryTo([&] {
            FlownPath flown = flownThrough(mEdit.keys(), session.flight());
            // The flight that was played before the keyframes can be restored.
            if (mFlown)
                session.paths().set(std::move(flown.path));
            else
                session.paths().edit([&](const RecordedPath&) { return std::move(flown.path); });
            mFlown = true;
        });
    mPath = session.paths().version();
}

}  // namespace stereonav
