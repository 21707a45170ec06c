// Eyes of pictures and videos that come together where the window's do: where the room is narrow. They never
// go wider apart than the scene has them.
#pragma once

#include "engine/image/eye_image.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

class NarrowedEyes {
public:
    // Those of the scene as they are, where it says (RoomAround::wallForPictures).
    explicit NarrowedEyes(const Scene& scene) : mScene(scene), mRoom(scene.offered<RoomAround>()) {}

    // At a pose at so many seconds: settled at the first one, and from there as slowly as in the window.
    // Casts a small picture.
    StereoSetting at(const Pose& head, double time);

private:
    void step(const Pose& head, double free, const RoomSeen& room, double dt);

    const Scene& mScene;
    const RoomAround* mRoom;   // null: they stay as they are
    StereoFollower mFollower;  // empty before the first
    ComfortLimit mComfort;
    StereoSetting mNow;
    double mTime = 0;
    EyeImage mLook;
};

}  // namespace stereonav
