// What a person flies through, whatever it is made of: where one may be, what the eyes are like, a flight of
// its own, and what makes its frames. What only some scenes can do (a sun that moves, slices to look at) is a
// small interface of its own that a scene may offer (capabilities.h). Commands and the window ask for the
// capability, never for the kind of scene.
#pragma once

#include <memory>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/nav/flight.h"
#include "engine/scene/facts.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

class Scene {
public:
    Scene() = default;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    virtual ~Scene() = default;

    std::string name;  // the name that it was asked for by
    Lens lens;         // width and height are the caller's to set
    StereoSetting stereo;
    bool eyesGiven = false;  // by an option or a scene's file: the window leaves them as they are
    Pose startPose;
    std::string warning;                 // what who sees a picture of it has to know; "": nothing
    RecordedPath path;                   // the scene's own flight; empty where there is none
    SimdTarget simd = SimdTarget::Auto;  // the instruction set that its frames are made with

    StereoViews viewsAt(const Pose& head) const { return makeStereoViews(head, lens, stereo); }

    // Makes this scene's frames; lives as long as it. To be used by one thread at a time, which is also the
    // one that changes what capabilities change.
    virtual FrameMaker& frames() const = 0;
    virtual std::unique_ptr<Flight> makeFlight() const = 0;
    // Whether a recorded flight may be played here. Throws Error naming `file`.
    virtual void check(const RecordedPath& /*path*/, const std::string& /*file*/) const {}
    // Returns what there is to say of it, a group ("terrain", "medium") for each thing that it is made of.
    // May make a frame.
    virtual Facts describe() const { return {}; }
    // Why its light stands still, for who asks for another; "" where TurningLight is offered.
    virtual std::string whyLightStays() const { return ""; }

    // What this scene offers of type C, null if it does not; lives as long as the scene.
    template <typename C>
    C* offered() const {
        for (const auto& [type, what] : mOffered)
            if (type == std::type_index(typeid(C))) return static_cast<C*>(what);
        return nullptr;
    }

protected:
    // capability outlives the scene, or is part of it. At most one of a type.
    template <typename C>
    void offer(C& capability) {
        mOffered.emplace_back(std::type_index(typeid(C)),
                              const_cast<void*>(static_cast<const void*>(&capability)));
    }

private:
    std::vector<std::pair<std::type_index, void*>> mOffered;
};

}  // namespace stereonav
