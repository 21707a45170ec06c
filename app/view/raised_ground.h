// New places of eyes, kept places and flights over ground whose heights are exaggerated by another factor: at
// the same height over the ground.
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
    // Returns empty where the scenes do not show the same ground with different factors. `after` must outlive
    // the result.
    static std::optional<RaisedGround> between(const Scene& before, const Scene& after);
    // Returns empty for a place that was kept over other ground, without its factor, or with the present one.
    static std::optional<RaisedGround> since(const Bookmark& place, const Scene& now);

    glm::dvec3 moved(const glm::dvec3& place) const;
    Pose moved(Pose pose) const;
    RecordedPath moved(const RecordedPath& path) const;
    Keyframes moved(Keyframes keys) const;

private:
    RaisedGround(const Heightfield& ground, double before) : mGround(&ground), mBefore(before) {}
    const Heightfield* mGround;
    double mBefore;  // earlier factor over the present one
};

// Returns what a place stores of its scene (Bookmark::settings).
std::string groundSettings(const Scene& scene);
// Returns the place over the ground as it is shown now.
Bookmark placeNow(const Bookmark& place, const Scene& now);

}  // namespace stereonav
