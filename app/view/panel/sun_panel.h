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
    // Returns whether options set the scene's sun.
    static bool has(const SceneChanges& changes);
    void draw(SceneChanges& changes, ViewSession& session);

private:
    void look(ViewSession& session);
    bool drawClock();
    bool drawPlace();

    std::weak_ptr<const OpenScene> mScene;
    std::optional<SunClock> mClock;
    bool mOnEarth = false;          // whether the place is that of the scene
    double mNorth = 0;              // azimuth of the Earth's north in the scene
    std::string mDate, mTime;       // texts that are being typed
    std::optional<SunClock> mTold;  // clock for which mThen was computed
    SunThen mThen;
};

}  // namespace stereonav
