// Where eyes, places and flights over a ground go when its heights are exaggerated otherwise: as high over
// the ground as they were.
#pragma once

#include <optional>

#include "app/view/bookmarks.h"
#include "engine/camera/keyframes.h"
#include "engine/camera/recorded_path.h"
#include "engine/scene/scene.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class RaisedGround {
public:
    // None where they do not show one ground, or show it by one scale. after: lives longer.
    static std::optional<RaisedGround> between(const Scene& before, const Scene& after);
    // Of a place that was kept over the same ground; none where it does not say by what scale, or by this.
    static std::optional<RaisedGround> since(const Bookmark& place, const Scene& now);

    glm::dvec3 moved(const glm::dvec3& place) const;
    Pose moved(Pose pose) const;
    RecordedPath moved(const RecordedPath& path) const;
    Keyframes moved(Keyframes keys) const;

private:
    RaisedGround(const Heightfield& ground, double before) : mGround(&ground), mBefore(before) {}
    const Heightfield* mGround;
    double mBefore;  // its heights were so many times what they are
};

// What a place remembers of the scene that it is kept of (Bookmark::settings).
std::string groundSettings(const Scene& scene);
// The place over the ground as it is shown now.
Bookmark placeNow(const Bookmark& place, const Scene& now);

}  // namespace stereonav
