// A capability (capabilities.h): a closed wall, for which it can be recorded what was on screen.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/camera/pose.h"
#include "engine/render/eye_painter.h"

namespace stereonav {

// Rules for what counts as seen, and for which unseen parts are listed.
struct WallLooking {
    double within = 0.1;                // metres from the eye, > 0
    double angle = 1.4835298641951802;  // radians, 85 degrees: off the wall's normal, in (0, pi / 2]
    double smallestPatch = 300e-6;      // square metres, >= 0
    bool operator==(const WallLooking&) const = default;
};

// A connected part of the wall that was not seen.
struct UnseenPart {
    double area = 0;           // square metres
    glm::dvec3 place{0.0};     // world, metres: on the part, near its middle
    double along = 0;          // metres along the line through the scene
    std::optional<Pose> view;  // a view that shows it; empty where there is no room for an eye
};

// The part of the wall that was seen so far. For one thread at a time, also while frames are made; the scene
// must outlive it.
class WallSeen {
public:
    virtual ~WallSeen() = default;
    // Adds the wall that these eyes show. Throws Cancelled.
    virtual void look(std::span<const EyeView> eyes, Progress& progress) = 0;
    // Forgets what was seen and judges by other rules from now on. Throws Error where a number is out of
    // range.
    virtual void judgeBy(const WallLooking& looking) = 0;
    virtual double percent() const = 0;                  // share of the wall's area seen, in percent
    virtual std::vector<UnseenPart> unseen() const = 0;  // largest first
    virtual std::shared_ptr<const EyePainter> painter() const = 0;  // tints what was not seen until now
};

class WallToSee {
public:
    virtual ~WallToSee() = default;
    // Begins without anything seen. Called on any thread. Throws Error (memory; a number out of range),
    // Cancelled.
    virtual std::unique_ptr<WallSeen> begin(const WallLooking& looking, Progress& progress) const = 0;
    // Returns the scene's own flight, or the way back. On any thread; may take seconds.
    virtual std::vector<Pose> ownFlight(bool back) const = 0;
};

}  // namespace stereonav
