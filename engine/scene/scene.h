// A scene for flight, whatever it is made of: where the viewer may be, its eyes, its own flight, and the
// maker of its frames. Features that only some scenes have (a sun that moves, slices to look at) are small
// interfaces of their own, which a scene may offer (capabilities.h). Commands and the window ask for the
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

    std::string name;  // the name or file that it was loaded by
    Lens lens;         // width and height are set by the caller
    StereoSetting stereo;
    bool eyesGiven = false;  // set by an option or a scene file: the window does not change them
    Pose startPose;
    std::string warning;                 // warning for everybody who sees a picture of it; "": none
    RecordedPath path;                   // the scene's own flight; empty where there is none
    SimdTarget simd = SimdTarget::Auto;  // instruction set for its frames

    StereoViews viewsAt(const Pose& head) const { return makeStereoViews(head, lens, stereo); }

    // Returns the maker of this scene's frames, which lives as long as the scene. For one thread at a time,
    // which also makes all changes through capabilities.
    virtual FrameMaker& frames() const = 0;
    virtual std::unique_ptr<Flight> makeFlight() const = 0;
    // Throws Error, naming `file`, where a recorded flight can not be played here.
    virtual void check(const RecordedPath& /*path*/, const std::string& /*file*/) const {}
    // Returns facts about the scene, a group ("terrain", "medium") for each of its parts. May make a frame.
    virtual Facts describe() const { return {}; }
    // Returns why its light can not be turned, for messages; "" where TurningLight is offered.
    virtual std::string whyLightStays() const { return ""; }

    // Returns the capability C, null where the scene does not offer it; it lives as long as the scene.
    template <typename C>
    C* offered() const {
        for (const auto& [type, what] : mOffered)
            if (type == std::type_index(typeid(C))) return static_cast<C*>(what);
        return nullptr;
    }

protected:
    // capability: outlives the scene, or is part of it. At most one of each type.
    template <typename C>
    void offer(C& capability) {
        mOffered.emplace_back(std::type_index(typeid(C)),
                              const_cast<void*>(static_cast<const void*>(&capability)));
    }

private:
    std::vector<std::pair<std::type_index, void*>> mOffered;
};

}  // namespace stereonav
