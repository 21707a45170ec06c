// Matches the lines through two scenes, such as two studies of one patient: which place on one line
// corresponds to which on the other.
#pragma once

#include <memory>

#include "engine/camera/pose.h"
#include "engine/scene/scene.h"

namespace stereonav {

// A match. Places are metres from the lines' starts, clamped to their ends. From any thread; does not refer
// to the scenes.
class LineMatch {
public:
    virtual ~LineMatch() = default;
    virtual double toOther(double along) const = 0;
    virtual double fromOther(double along) const = 0;
    // Returns how different matched places are: 0 for a line with itself.
    virtual double cost() const = 0;
    // Returns whether both can be the same anatomy; if not, matched places mean nothing.
    virtual bool matches() const = 0;
};

// A capability (capabilities.h), beside LineThrough.
class MatchingLine {
public:
    virtual ~MatchingLine() = default;
    // Matches the line with that of another scene. Throws Error that names the other scene where it has no
    // line.
    virtual std::shared_ptr<const LineMatch> matchWith(const Scene& other) const = 0;
    // Returns a pose on the line, looking along it, as upright as possible; back: towards its start.
    virtual Pose poseOnLine(double along, bool back) const = 0;
};

// Returns whether a viewer at `along` with this pose looks towards the line's start.
bool looksBack(const MatchingLine& line, double along, const Pose& eye);

}  // namespace stereonav
