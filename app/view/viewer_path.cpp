// The viewer's part that brings keyframes and the flight that is played together.
#include "app/view/viewer.h"

namespace stereonav {

// The flight follows them, but not while one is dragged. Where another flight takes its place they end.
void Viewer::followKeyframes() {
    if (mKeyframes.any() && mKeyframes.version() == mKeyframesSeen &&
        mSession->pathVersion() != mKeyframesPath)
        mKeyframes.start({});
    if (!mKeyframes.any() && !mKeyframes.canUndo()) mKeyframesFlown = false;
    if (mKeyframes.version() == mKeyframesSeen || mKeyframes.dragging()) return;
    mKeyframesSeen = mKeyframes.version();
    if (mKeyframes.keys().size() > 1)
        mNotices.tryTo([this] {
            FlownPath flown = flownThrough(mKeyframes.keys(), mSession->flight());
            // What was played before them can be had back.
            if (mKeyframesFlown)
                mSession->setPath(std::move(flown.path));
            else
                mSession->editPath([&](const RecordedPath&) { return std::move(flown.path); });
            mKeyframesFlown = true;
        });
    mKeyframesPath = mSession->pathVersion();
}

void Viewer::openPath(const std::filesystem::path& file) {
    if (!mSession) return;
    mNotices.tryTo([&] { mSession->openPath(readPath(file)); });
}

}  // namespace stereonav
