// Two scenes with a way through each, such as two studies of one patient: which place of one way is which of
// the other.
#pragma once

#include <memory>

#include "engine/camera/pose.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Metres from the ways' starts; what lies beyond an end counts as the end. From any thread; of no scene's
// memory.
class LineMatch {
public:
    virtual ~LineMatch() = default;
    virtual double toOther(double along) const = 0;
    virtual double fromOther(double along) const = 0;
    // How unlike matched places are: 0 of a way with itself.
    virtual double cost() const = 0;
    // Returns whether both may be the same way; where they are not, their places have nothing to do with each
    // other.
    virtual bool matches() const = 0;
};

// A capability (capabilities.h), beside LineThrough.
class MatchingLine {
public:
    virtual ~MatchingLine() = default;
    // Matches the line with that of another scene. Throws Error that names it where it has none.
    virtual std::shared_ptr<const LineMatch> matchWith(const Scene& other) const = 0;
    // Returns a pose on the line, looking along it, as upright as can be; back: towards its start.
    virtual Pose poseOnLine(double along, bool back) const = 0;
};

// Returns whether who looks so from a place `along` the way looks towards its start.
bool looksBack(const MatchingLine& line, double along, const Pose& eye);

}  // namespace stereonav
