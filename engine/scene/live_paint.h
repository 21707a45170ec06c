// What a scene's surfaces are painted with (surface_paint.h), exchanged while frames are made and nothing is
// read again: what is quick at once, the rest beside the flight, the last picture kept until it is there.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "engine/render/paint_legend.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Paint that is being computed beside the frames.
struct PaintWork {
    double fraction = 0;
    std::string what;
};

// A capability (capabilities.h). Paint is said by the keys and texts of options. Called by one thread, but
// takeUp().
class LivePaint {
public:
    virtual ~LivePaint() = default;
    // Returns whether the scene can be painted so without being loaded again. "": nothing is painted by that
    // key.
    virtual bool takes(const std::string& key, const std::string& text) const = 0;
    // Returns the paint that was asked for last. What could not be had, or was cancelled, goes back to what
    // is shown.
    virtual std::string now(const std::string& key) const = 0;
    // Returns at once. Throws Error for texts that the option does not take.
    virtual void ask(const std::string& key, const std::string& text) = 0;
    // Asks for a paint of what is seen from a place, world x, y, at `height` above the ground: `paint` has
    // its text when it is there.
    virtual void askSeenFrom(const glm::dvec2& place, double height) = 0;

    // Another one whenever what is painted changes: the frame is to be made again.
    virtual long long version() const = 0;
    virtual std::shared_ptr<const PaintLegend> legend() const = 0;  // never null
    virtual std::optional<PaintWork> work() const = 0;
    virtual void cancel() = 0;
    virtual std::string takeProblem() = 0;  // since the last call; "": none

    // Called before a frame, by the thread that makes it: paints what is there by now.
    virtual void takeUp() = 0;
};

// 0 where nothing of it can be exchanged.
inline long long paintVersion(const Scene& scene) {
    const auto* const paint = scene.offered<LivePaint>();
    return paint ? paint->version() : 0;
}

}  // namespace stereonav
