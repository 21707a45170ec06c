// Keyframes of a flight that a person moves about on a map: which one is chosen, what is being dragged, steps
// back and forth; and the flight through them as it will be flown, clear of the ground.
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
    void choose(std::optional<std::size_t> key);    // one that is not there: none
    long long version() const { return mVersion; }  // grows with every change of the keyframes

    // Anew with these, without steps back; none ends the work.
    void start(Keyframes keys);
    // After the chosen one, or as the last; it is chosen then. The way there and on takes what it takes at
    // this speed, metres a second (timedKeyframes). Throws Error for what is no pose or speed.
    void add(const Pose& eye, double metresPerSecond);
    void removeChosen();  // the one before it is chosen then

    // A place for the keyframe that is dragged; its head stays as it was. What lies beside it in time is
    // moved on, so that it is flown there at the pace that it had. Any other change ends a drag first, as a
    // step of its own; a step back or forth drops it.
    void beginDrag(std::size_t key);
    bool dragging() const { return mDragged.has_value(); }
    const Pose& draggedFrom() const { return mBeforeDrag[*mDragged].pose; }  // while one is dragged
    void dragTo(const glm::dvec3& place);                                    // what is not finite is nothing
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

// As few keyframes as keep to a flight, within a hundredth of its length and a few degrees; or within more,
// where that takes more than there are handles for on a map. Throws Error for a path that is empty.
Keyframes keyframesToEdit(const RecordedPath& path);

// The place over a point of the map, as high over where the viewer is let as `from` is (Flight::lowestAt), at
// least there; as high as `from` where there is no ground.
glm::dvec3 overGround(const Flight& flight, const glm::dvec3& from, const glm::dvec2& to);
// Over where the viewer is let, metres; none where there is no ground.
std::optional<double> heightOverGround(const Flight& flight, const glm::dvec3& place);

struct FlownPath {
    RecordedPath path;          // empty for fewer than two keyframes
    std::vector<char> blocked;  // from each of its samples to the next: 1 where something is in the way
    bool anyBlocked = false;
};
// The flight through them, raised where it would pass below where the viewer is let: no more than that at the
// worst place of about a second, smoothly around it.
FlownPath flownThrough(const Keyframes& keys, const Flight& flight);

}  // namespace stereonav
