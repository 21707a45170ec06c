// Moves eyes, bookmarks and flights when the vertical scale of the ground below them changes, so that they
// keep their height over the ground.
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
    // Returns nothing unless both scenes show the same ground, with different vertical scales. `after` must
    // outlive the result.
    static std::optional<RaisedGround> between(const Scene& before, const Scene& after);
    // Returns nothing where `now` is no terrain, and for a bookmark without a vertical scale or with the
    // present one.
    static std::optional<RaisedGround> since(const Bookmark& place, const Scene& now);

    glm::dvec3 moved(const glm::dvec3& place) const;
    Pose moved(Pose pose) const;
    RecordedPath moved(const RecordedPath& path) const;
    Keyframes moved(Keyframes keys) const;

private:
    RaisedGround(const Heightfield& ground, double before) : mGround(&ground), mBefore(before) {}
    const Heightfield* mGround;
    double mBefore;  // earlier vertical scale divided by the present one
};

// Returns what a bookmark keeps of its scene (Bookmark::settings).
std::string groundSettings(const Scene& scene);
// Returns the bookmark, moved onto the ground as it is shown now.
Bookmark placeNow(const Bookmark& place, const Scene& now);

}  // namespace stereonav
