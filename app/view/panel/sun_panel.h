// The sun by date, time and place, under "Light".
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/view/scene_changes.h"
#include "app/view/sun_clock.h"

namespace stereonav {

class SunPanel {
public:
    // Whether the scene has a sun that options place.
    static bool has(const SceneChanges& changes);
    void draw(SceneChanges& changes, ViewSession& session);

private:
    void look(ViewSession& session);
    bool drawClock();
    bool drawPlace();

    std::weak_ptr<const OpenScene> mScene;
    std::optional<SunClock> mClock;
    bool mOnEarth = false;          // the place is the scene's own
    double mNorth = 0;              // of the Earth, in the scene
    std::string mDate, mTime;       // while they are typed
    std::optional<SunClock> mTold;  // what mThen is of
    SunThen mThen;
};

}  // namespace stereonav
