// Eyes of pictures and videos, which come together in narrow rooms like those of the window. They never go
// farther apart than the scene sets them.
#pragma once

#include "engine/image/eye_image.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

class NarrowedEyes {
public:
    // Keeps the scene's eyes unchanged where it has no wall for pictures (RoomAround::wallForPictures).
    explicit NarrowedEyes(const Scene& scene) : mScene(scene), mRoom(scene.offered<RoomAround>()) {}

    // Returns the eyes at a pose and a time in seconds: settled at the first call, then changing as slowly as
    // in the window. Casts a small picture.
    StereoSetting at(const Pose& head, double time);

private:
    void step(const Pose& head, double free, const RoomSeen& room, double dt);

    const Scene& mScene;
    const RoomAround* mRoom;   // null: the eyes stay unchanged
    StereoFollower mFollower;  // empty before the first call
    ComfortLimit mComfort;
    StereoSetting mNow;
    double mTime = 0;
    EyeImage mLook;
};

}  // namespace stereonav
