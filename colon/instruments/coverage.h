// Coverage: which part of a lumen's wall was on screen along a flight. What was missed is a list of patches,
// each with a place to look at it from.
//
// A place of the wall counts as seen from a pose where it lies in the picture, no further than a set
// distance, is met at no more than a set angle off its normal, and nothing is between. As Pickhardt, Taylor
// and Gopal, "Surface visualization at 3D endoluminal CT colonography: degree of coverage and implications
// for polyp detection", Gastroenterology 130 (2006); there distance and angle are not limited.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/camera/pose.h"

namespace stereonav {

class Peers;

struct CoverageSetting {
    double verticalFov = 1.5707963267948966;  // radians, in (0, pi)
    double aspect = 1;                        // width of the picture over its height, > 0
    double within = 0.1;                      // metres from the eye at most, > 0
    double angle = 1.4835298641951802;        // radians, 85 degrees: off the wall's normal, in (0, pi / 2]
    double smallestPatch = 300e-6;            // square metres, >= 0
};

// A part of the wall that hangs together and was not seen.
struct UnseenPatch {
    double area = 0;                      // square metres
    glm::dvec3 place{0.0};                // world, metres: on it, next to its middle
    std::vector<std::uint32_t> vertices;  // numbers of the mesh's vertices, ascending
    std::optional<Pose> view;             // shows it; none where there is no room for an eye
};

class Coverage {
public:
    // Returns the distance free of wall around a place, metres, at most upTo (ColonScene::freeDistanceAt).
    using FreeDistance = std::function<double(const glm::dvec3& world, double upTo)>;

    // mesh, neighbours and sight must outlive the object. Nothing is seen yet. Throws Error for settings out
    // of range.
    Coverage(const WallMesh& mesh, const WallNeighbours& neighbours, const LineOfSight& sight,
             const CoverageSetting& setting);

    // Adds what is seen from these, by the setting's field of view. The result depends neither on the number
    // of threads nor on the order. Throws Cancelled.
    void look(std::span<const Pose> poses, Progress& progress);
    // Adds what is in these pictures.
    void look(std::span<const EyeView> eyes, Progress& progress);
    // From here on the wall is shared with the other processes of this run, each of which calls look() as
    // this one does; the first has what is seen, the others have nothing of use. peers must outlive the
    // object.
    void shareWith(Peers& peers) { mPeers = &peers; }
    // Forgets all that was seen. Throws as the constructor.
    void startAgain(const CoverageSetting& setting);

    double percent() const;  // 0 to 100 of the wall's area; 0 of a wall without area
    const std::vector<std::uint8_t>& seen() const { return mSeen; }  // by vertex, 0 or 1

    // Returns the patches of at least the set size, largest first, with their views. clearance: metres that
    // the eye keeps.
    std::vector<UnseenPatch> patches(const FreeDistance& freeDistance, double clearance) const;

    // Views of a patch at most in visit().
    static constexpr int kMostViews = 6;
    // Looks at each of them, and at what is left of it while that is of the set size and a view shows more of
    // it, at most kMostViews times each. clearance: metres. Returns the number of views. Throws Cancelled.
    int visit(const std::vector<UnseenPatch>& patches, const FreeDistance& freeDistance, double clearance,
              Progress& progress);

private:
    struct Chunk {  // vertices that are near each other, and the ball around them
        std::uint32_t from, to;
        glm::vec3 middle;  // world, metres
        float radius;      // metres
    };
    void makeChunks();
    void lookHere(std::span<const EyeView> eyes, Progress& progress);
    void lookAt(std::size_t chunk, std::span<const EyeView> eyes);
    void lookShared(std::span<const EyeView> eyes, Progress& progress);
    std::span<std::uint8_t> seenOf(std::size_t firstChunk, std::size_t chunks);
    EyeView viewFrom(const Pose& pose) const;
    bool reaches(const Chunk& chunk, const EyeView& view) const;
    bool sees(const EyeView& view, std::uint32_t vertex) const;
    glm::dvec3 lifted(std::uint32_t vertex) const;
    std::vector<UnseenPatch> patchesAmong(const std::vector<std::uint32_t>& vertices) const;
    std::optional<Pose> viewOf(std::uint32_t vertex, const FreeDistance& freeDistance,
                               double clearance) const;

    const WallMesh& mMesh;
    const WallNeighbours& mNeighbours;
    const LineOfSight& mSight;
    CoverageSetting mSetting;
    std::vector<Chunk> mChunks;
    std::vector<std::uint8_t> mSeen;
    Peers* mPeers = nullptr;  // none: this process looks at all of it
};

// Returns a mark by vertex: 1 where it was not seen, else 0.
std::vector<float> unseenMarks(const std::vector<std::uint8_t>& seen);

}  // namespace stereonav
