// Eyes of pictures and videos that come together where the window's do: where the room is narrow. They never
// go wider apart than the scene has them.
#pragma once

#include "app/scene/scene_loading.h"
#include "engine/image/eye_image.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

class NarrowedEyes {
public:
    // Those of the scene as they are, where it says (LoadedScene::eyesFollow).
    explicit NarrowedEyes(const LoadedScene& scene) : mScene(scene) {}

    // At a pose at so many seconds: settled at the first one, and from there as slowly as in the window.
    // Casts a small picture.
    StereoSetting at(const Pose& head, double time);

private:
    void step(const Pose& head, double free, const RoomSeen& room, double dt);

    const LoadedScene& mScene;
    StereoFollower mFollower;  // empty before the first
    ComfortLimit mComfort;
    StereoSetting mNow;
    double mTime = 0;
    EyeImage mLook;
};

}  // namespace stereonav
