// Coverage: the part of a lumen's wall that was on screen during a flight. Missed parts are listed as
// patches, each with a pose from which it can be seen.
//
// A place on the wall counts as seen from a pose if it lies in the picture, within a set distance and a set
// angle off its normal, and nothing hides it. Like Pickhardt, Taylor and Gopal, "Surface visualization at 3D
// endoluminal CT colonography: degree of coverage and implications for polyp detection", Gastroenterology 130
// (2006), who do not limit distance and angle.
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
    double aspect = 1;                        // width divided by height of the picture, > 0
    double within = 0.1;                      // largest distance from the eye, metres, > 0
    double angle = 1.4835298641951802;        // radians, 85 degrees: off the wall's normal, in (0, pi / 2]
    double smallestPatch = 300e-6;            // square metres, >= 0
};

// A connected part of the wall that was not seen.
struct UnseenPatch {
    double area = 0;                      // square metres
    glm::dvec3 place{0.0};                // world, metres: on the patch, near its middle
    std::vector<std::uint32_t> vertices;  // indices of the mesh's vertices, ascending
    // A pose from which it is seen; empty where there is no room for an eye.
    std::optional<Pose> view;
};

class Coverage {
public:
    // Returns the distance in metres from a place to the wall, at most upTo (ColonScene::freeDistanceAt).
    using FreeDistance = std::function<double(const glm::dvec3& world, double upTo)>;

    // mesh, neighbours and sight must outlive this object. At first nothing is seen. Throws Error for
    // settings out of range.
    Coverage(const WallMesh& mesh, const WallNeighbours& neighbours, const LineOfSight& sight,
             const CoverageSetting& setting);

    // Adds the wall that is seen from these poses, with the setting's field of view. The result depends
    // neither on the number of threads nor on the order. Throws Cancelled.
    void look(std::span<const Pose> poses, Progress& progress);
    // Adds the wall that is seen in these views.
    void look(std::span<const EyeView> eyes, Progress& progress);
    // Shares the work with the other processes of this run, each of which must call look() as this one does;
    // the first process has the result, the others have nothing of use. peers must outlive this object.
    void shareWith(Peers& peers) { mPeers = &peers; }
    // Forgets everything that was seen. Throws as the constructor.
    void startAgain(const CoverageSetting& setting);

    double percent() const;  // percent of the wall's area; 0 for a wall without area
    const std::vector<std::uint8_t>& seen() const { return mSeen; }  // by vertex, 0 or 1

    // Returns the patches of at least the set size, largest first, with their poses. clearance: metres that
    // the eye keeps from the wall.
    std::vector<UnseenPatch> patches(const FreeDistance& freeDistance, double clearance) const;

    // Largest number of views of one patch in visit().
    static constexpr int kMostViews = 6;
    // Looks at each patch, and again at the rest of it as long as that has the set size and another view
    // shows more of it, at most kMostViews times. clearance: metres. Returns the number of views. Throws
    // Cancelled.
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
    Peers* mPeers = nullptr;  // null: this process does all the work
};

// Returns a mark for each vertex: 1 where it was not seen, else 0.
std::vector<float> unseenMarks(const std::vector<std::uint8_t>& seen);

}  // namespace stereonav
