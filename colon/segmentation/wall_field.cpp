// A voxel beside the wall has the distance to the planes through the crossings beside it. From there
// distances go on from voxel to voxel of the same side, along the mean normals of those they come from: away
// from the wall by as much as a step leads away. So the two sides of a septum of one voxel do not mix.
#include "colon/segmentation/wall_field.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "colon/segmentation/lumen_surface.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kTileSide = 32;
// Steps from the wall. Normals at the corners of cells that hold it look at voxels four steps away.
constexpr int kSteps = 5;
constexpr float kLeastAway = 2;  // HU that voxel centres keep from kMaskWall, on their side of it

// Returns the share of the way from the wall's value to those far away, for a distance in units of that where
// a straight line would reach it: straight near the wall, then a parabola without a bend at either end, so
// that films of values between follow the wall too.
float shareAway(float distance) {
    constexpr float kStraight = 0.6f, kEnd = 2 - kStraight;
    if (distance <= kStraight) return distance;
    const float left = std::max(kEnd - distance, 0.0f);
    return 1 - left * left / (2 * (kEnd - kStraight));
}

// What is known of a voxel near the wall; sums, until they are divided by the weight.
struct NearWall {
    glm::vec3 normal{0.0f};  // outwards
    float distance = 0;      // from the wall, on the voxel's side
    float weight = 0;
};

// Fills tiles one after the other, on one thread.
class WallTiles {
public:
    WallTiles(const VoxelRuns& inside, const WallCrossings& wall, const std::vector<glm::vec3>& normals,
              GreyVolume& field)
        : mInside(inside), mWall(wall), mNormals(normals), mField(field), mSpacing(field.frame.spacing) {
        const float least = std::min({mSpacing.x, mSpacing.y, mSpacing.z});
        const float most = std::max({mSpacing.x, mSpacing.y, mSpacing.z});
        mFar = std::max(2.5f * least, 1.5f * most);
    }

    void run(const glm::ivec3& first, const glm::ivec3& end) {
        mLow = glm::max(first - kSteps, glm::ivec3(0));
        mSize = glm::min(end + kSteps, mInside.size) - mLow;
        fillFar(first, end);
        mFront.clear();
        prepare();
        addCrossings();
        finish(1);
        for (int step = 2; step <= kSteps && !mFront.empty(); ++step) {
            mLast.swap(mFront);
            mFront.clear();
            for (const std::uint32_t from : mLast) passOn(from);
            finish(step);
        }
        store(first, end);
    }

private:
    std::size_t count() const { return static_cast<std::size_t>(mSize.x) * mSize.y * mSize.z; }
    glm::ivec3 strides() const { return {1, mSize.x, mSize.x * mSize.y}; }
    std::uint32_t index(const glm::ivec3& v) const {
        return static_cast<std::uint32_t>(v.x + mSize.x * (v.y + mSize.y * v.z));
    }
    bool holds(const glm::ivec3& v) const {
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < mSize.x && v.y < mSize.y && v.z < mSize.z;
    }

    void fillFar(const glm::ivec3& first, const glm::ivec3& end) {
        for (int k = first.z; k < end.z; ++k)
            for (int j = first.y; j < end.y; ++j)
                for (const VoxelRun& run : mInside.row(j, k)) {
                    const int from = std::max(run.first, first.x), to = std::min(run.end, end.x);
                    if (from < to) std::fill_n(&mField.at(from, j, k), to - from, std::int16_t{kMaskInside});
                }
    }

    // Makes the voxels of the tile and around it unknown, and says which are inside.
    void prepare() {
        mIn.assign(count(), 0);
        mStep.assign(count(), 0);
        mNear.resize(std::max(mNear.size(), count()));
        for (int k = 0; k < mSize.z; ++k)
            for (int j = 0; j < mSize.y; ++j)
                for (const VoxelRun& run : mInside.row(j + mLow.y, k + mLow.z)) {
                    const int from = std::max(run.first - mLow.x, 0),
                              to = std::min(run.end - mLow.x, mSize.x);
                    if (from < to) std::fill_n(&mIn[index({from, j, k})], to - from, std::uint8_t{1});
                }
    }

    void add(std::uint32_t voxel, float distance, float weight, const glm::vec3& normal) {
        NearWall& near = mNear[voxel];
        if (mStep[voxel] == 0) {
            near = {};
            mStep[voxel] = kSummed;
            mFront.push_back(voxel);
        }
        near.distance += weight * distance;
        near.weight += weight;
        near.normal += weight * normal;
    }

    void addCrossings() {
        for (int k = mLow.z; k < mLow.z + mSize.z; ++k)
            for (int j = mLow.y; j < mLow.y + mSize.y; ++j)
                for (int axis = 0; axis < 3; ++axis) addRow(axis, j, k);
    }
    void addRow(int axis, int j, int k) {
        const std::size_t list = 3 * mInside.rowNumber(j, k) + static_cast<std::size_t>(axis);
        const auto begin = mWall.column.begin(), end = begin + mWall.start[list + 1];
        for (auto at = std::lower_bound(begin + mWall.start[list], end, mLow.x - 1);
             at != end && *at < mLow.x + mSize.x; ++at) {
            const auto n = static_cast<std::size_t>(at - begin);
            const glm::vec3& normal = mNormals[n];
            const float facing = std::abs(normal[axis]), way = facing * mSpacing[axis],
                        weight = facing * facing;
            if (!(weight > 0)) continue;
            const glm::ivec3 lower = glm::ivec3(*at, j, k) - mLow;
            glm::ivec3 upper = lower;
            ++upper[axis];
            if (holds(lower)) add(index(lower), mWall.at[n] * way, weight, normal);
            if (holds(upper)) add(index(upper), (1 - mWall.at[n]) * way, weight, normal);
        }
    }

    // What was summed for voxels becomes their own.
    void finish(int step) {
        for (const std::uint32_t n : mFront) {
            NearWall& near = mNear[n];
            near.distance /= near.weight;
            const float length = glm::length(near.normal);
            near.normal = length > 1e-6f * near.weight ? near.normal / length : glm::vec3(0.0f);
            mStep[n] = static_cast<std::uint8_t>(step);
        }
    }

    void passOn(std::uint32_t from) {
        const NearWall near = mNear[from];
        const glm::ivec3 stride = strides();
        const auto at = static_cast<int>(from);
        const glm::ivec3 v(at % mSize.x, at / mSize.x % mSize.y, at / stride.z);
        for (int axis = 0; axis < 3; ++axis) {
            const float facing = mIn[from] ? -near.normal[axis] : near.normal[axis];
            const int side = facing > 0 ? 1 : -1, beside = v[axis] + side;
            if (facing == 0 || beside < 0 || beside >= mSize[axis]) continue;
            const auto to = static_cast<std::uint32_t>(at + side * stride[axis]);
            if ((mStep[to] != 0 && mStep[to] != kSummed) || mIn[to] != mIn[from]) continue;
            add(to, near.distance + std::abs(facing) * mSpacing[axis], facing * facing, near.normal);
        }
    }

    void store(const glm::ivec3& first, const glm::ivec3& end) {
        const float half = (kMaskOutside - kMaskInside) / 2.0f;
        for (int k = first.z; k < end.z; ++k)
            for (int j = first.y; j < end.y; ++j) {
                std::uint32_t n = index(glm::ivec3(first.x, j, k) - mLow);
                for (int i = first.x; i < end.x; ++i, ++n) {
                    if (mStep[n] == 0) continue;
                    const float away = std::max(half * shareAway(mNear[n].distance / mFar), kLeastAway);
                    mField.at(i, j, k) =
                        static_cast<std::int16_t>(std::lround(kMaskWall + (mIn[n] ? -away : away)));
                }
            }
    }

    static constexpr std::uint8_t kSummed = 255;  // in the front, not finished

    const VoxelRuns& mInside;
    const WallCrossings& mWall;
    const std::vector<glm::vec3>& mNormals;
    GreyVolume& mField;
    glm::vec3 mSpacing;
    float mFar = 1;                            // distance from the wall at which a straight line ends
    glm::ivec3 mLow{0}, mSize{0};              // the tile and what is around it
    std::vector<std::uint8_t> mIn, mStep;      // whether inside; steps from the wall, 0: unknown
    std::vector<NearWall> mNear;               // where mStep is not 0
    std::vector<std::uint32_t> mFront, mLast;  // voxels of this step and of the one before
};

}  // namespace

void fillWallField(const VoxelRuns& inside, const WallCrossings& wall, const std::vector<glm::vec3>& normals,
                   GreyVolume& field, Progress& progress) {
    const glm::ivec3 size = inside.size, tiles = (size + (kTileSide - 1)) / kTileSide;
    ProgressSteps rows(progress, static_cast<std::size_t>(tiles.y) * tiles.z, "smoothing the wall");
    parallelFor(tiles.y * tiles.z, [&](int n) {
        if (progress.cancelled()) throw Cancelled();
        WallTiles tile(inside, wall, normals, field);
        for (int x = 0; x < tiles.x; ++x) {
            const glm::ivec3 first = glm::ivec3(x, n % tiles.y, n / tiles.y) * kTileSide;
            tile.run(first, glm::min(first + kTileSide, size));
        }
        rows.done();
    });
}

}  // namespace stereonav
