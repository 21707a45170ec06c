// What the mouse does in a session: it turns, pans and zooms about a place (engine/nav/pivot_motion.h), or
// looks around and sets the speed. Scenes seen from outside begin with the first, others with the second.
#pragma once

#include <optional>

#include "engine/nav/flight.h"
#include "engine/nav/pivot_motion.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Ways of dragging.
enum class OrbitDrag { Turn, Pan, Zoom };

class SessionOrbit {
public:
    explicit SessionOrbit(const Scene& scene);
    void replaceScene(const Scene& scene);  // the mouse goes on doing the same

    bool on() const { return mOn; }
    void set(bool on);
    bool startsOn() const { return mStartsOn; }

    // Takes the place that the coming drags and zooms are about, world, metres; empty: the middle of the
    // object, or of what is known of the scene. depth: metres ahead of the head where nothing is known.
    void takeHold(const std::optional<glm::dvec3>& place, const Pose& head, double depth);
    const glm::dvec3& pivot() const { return mMotion.pivot(); }

    // Return where the head goes. by: the pointer's motion to the right and up, in units of the picture's
    // plane at view depth 1, of which the picture is `height` high.
    Pose dragged(const Pose& head, OrbitDrag drag, const glm::dvec2& by, double height);
    void zoomBy(double notches);  // notches of a wheel: each comes nearer by a sixth
    bool zooming() const { return mMotion.zooming(); }
    void endZoom() { mMotion.endZoom(); }
    Pose zoomed(const Pose& head, double dt) { return mMotion.zoomed(head, dt); }

private:
    bool mOn, mStartsOn;
    std::optional<glm::dvec3> mMiddle;
    PivotMotion mMotion;
};

}  // namespace stereonav
