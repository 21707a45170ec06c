// Keyframes of a flight that the user edits on a map: which one is chosen, what is being dragged, undo and
// redo; and the flight through them as it will be flown, clear of the ground.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/camera/keyframes.h"
#include "engine/nav/flight.h"

namespace stereonav {

class KeyframeEdit {
public:
    const Keyframes& keys() const { return mKeys; }
    bool any() const { return !mKeys.empty(); }
    std::optional<std::size_t> chosen() const { return mChosen; }
    void choose(std::optional<std::size_t> key);    // an index that does not exist: none
    long long version() const { return mVersion; }  // grows with every change of the keyframes

    // Begins with these keyframes, without undo; an empty list ends the editing.
    void start(Keyframes keys);
    // Adds a keyframe after the chosen one, or at the end, and chooses it. The times to and from it follow
    // from this speed in metres per second (timedKeyframes). Throws Error for an invalid pose or speed.
    void add(const Pose& eye, double metresPerSecond);
    void removeChosen();  // the one before it is chosen then

    // Drags a keyframe to a place; its head stays as it was. Neighbours in time are moved so that the pace
    // stays the same. Any other change first ends the drag, as a step of its own; undo and redo drop it.
    void beginDrag(std::size_t key);
    bool dragging() const { return mDragged.has_value(); }
    const Pose& draggedFrom() const { return mBeforeDrag[*mDragged].pose; }  // only while one is dragged
    void dragTo(const glm::dvec3& place);                                    // ignores infinite places
    void endDrag();

    bool canUndo() const { return !mBefore.empty(); }
    bool canRedo() const { return !mAfter.empty(); }
    void undo();
    void redo();

private:
    void change(Keyframes keys, std::optional<std::size_t> chosen);
    void show(Keyframes keys);

    Keyframes mKeys, mBeforeDrag;
    std::optional<std::size_t> mChosen, mDragged;
    std::vector<Keyframes> mBefore, mAfter;  // nearest last
    long long mVersion = 0;
};

// Returns as few keyframes as follow a flight within a hundredth of its length and a few degrees; or less
// exactly, where that needs more than the map has handles for. Throws Error for an empty path.
Keyframes keyframesToEdit(const RecordedPath& path);

// Returns the place over a point of the map at the same height above the lowest permitted one
// (Flight::lowestAt) as `from`, or at least at that; at the height of `from` where there is no ground.
glm::dvec3 overGround(const Flight& flight, const glm::dvec3& from, const glm::dvec2& to);
// Returns the height above the lowest permitted one in metres; empty where there is no ground.
std::optional<double> heightOverGround(const Flight& flight, const glm::dvec3& place);

struct FlownPath {
    RecordedPath path;          // empty for fewer than two keyframes
    std::vector<char> blocked;  // for each sample: 1 where something blocks the way to the next
    bool anyBlocked = false;
};
// Returns the flight through the keyframes, raised where it would pass below the lowest permitted height: by
// what the worst place of about a second needs, smoothly around it.
FlownPath flownThrough(const Keyframes& keys, const Flight& flight);

}  // namespace stereonav
