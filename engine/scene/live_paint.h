// Paint of a scene's surfaces (surface_paint.h) that is exchanged while frames are made, without reading
// files again. Quick paint changes at once; other paint is computed during flight, and the last picture stays
// until it is ready.
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

// A capability (capabilities.h). Paint is described by the keys and texts of options. For one thread, except
// takeUp().
class LivePaint {
public:
    virtual ~LivePaint() = default;
    // Returns whether the scene can show this paint without being loaded again. "": no paint for that key.
    virtual bool takes(const std::string& key, const std::string& text) const = 0;
    // Returns the paint that was asked for last. After a failure or a cancellation that is the paint being
    // shown.
    virtual std::string now(const std::string& key) const = 0;
    // Asks for a paint; returns at once. Throws Error for texts that the option does not accept.
    virtual void ask(const std::string& key, const std::string& text) = 0;
    // Asks for a paint of what is seen from a place, world x, y, at `height` above the ground; the option
    // `paint` has its text when it is ready.
    virtual void askSeenFrom(const glm::dvec2& place, double height) = 0;

    // Returns a version that differs whenever the paint changes: the frame must then be made again.
    virtual long long version() const = 0;
    virtual std::shared_ptr<const PaintLegend> legend() const = 0;  // never null
    virtual std::optional<PaintWork> work() const = 0;
    virtual void cancel() = 0;
    virtual std::string takeProblem() = 0;  // failure since the last call; "": none

    // Called before each frame by the thread that makes it: shows the paint that is ready by now.
    virtual void takeUp() = 0;
};

// Returns LivePaint::version(), 0 where the scene offers none.
inline long long paintVersion(const Scene& scene) {
    const auto* const paint = scene.offered<LivePaint>();
    return paint ? paint->version() : 0;
}

}  // namespace stereonav
