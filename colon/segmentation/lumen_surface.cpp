// Antialiasing of a binary volume: smoothed, while every voxel centre keeps its side of the surface (Whitaker
// 2000; Gibson's constrained elastic nets 1998 bind the surface in the same way). There a level set is moved
// by curvature for some hundred steps; here one wide kernel is enough: twice a Gaussian less that Gaussian
// applied twice, which leaves curved walls where they are to second order, where a Gaussian alone pulls them
// inwards until the voxel centres hold them. Work is done in tiles that hold surface, and there in the box
// around it.
#include "colon/segmentation/lumen_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/base/parallel.h"
#include "engine/volume/gaussian.h"

namespace stereonav {
namespace {

constexpr int kTile = 32;

struct Box {
    glm::ivec3 first{0}, end{0};
    glm::ivec3 size() const { return end - first; }
    std::size_t count() const { return static_cast<std::size_t>(size().x) * size().y * size().z; }
    bool empty() const { return end.x <= first.x || end.y <= first.y || end.z <= first.z; }
};

Box grown(const Box& box, const glm::ivec3& by) {
    return {box.first - by, box.end + by};
}
Box common(const Box& a, const Box& b) {
    return {glm::max(a.first, b.first), glm::min(a.end, b.end)};
}

// Signs of a box: -1 inside, 1 outside and beyond the volume.
void fillSigns(const VoxelRuns& inside, const Box& box, std::vector<float>& signs) {
    signs.assign(box.count(), 1.0f);
    const glm::ivec3 size = box.size();
    for (int k = std::max(0, box.first.z); k < std::min(inside.size.z, box.end.z); ++k)
        for (int j = std::max(0, box.first.y); j < std::min(inside.size.y, box.end.y); ++j) {
            float* row = signs.data() +
                         (static_cast<std::size_t>(k - box.first.z) * size.y + (j - box.first.y)) * size.x;
            for (const VoxelRun& run : inside.row(j, k)) {
                const int first = std::max(run.first - box.first.x, 0);
                const int end = std::min(run.end - box.first.x, size.x);
                if (first < end) std::fill(row + first, row + end, -1.0f);
            }
        }
}

// The box of voxels that differ from a neighbour in the box; empty when all are alike.
Box borderOf(const std::vector<float>& signs, const Box& box) {
    const glm::ivec3 size = box.size();
    glm::ivec3 low(size), high(-1);
    const std::size_t rows = static_cast<std::size_t>(size.x), slices = rows * size.y;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j) {
            const float* row = signs.data() + k * slices + j * rows;
            const float* nextRow = j + 1 < size.y ? row + rows : row;
            const float* nextSlice = k + 1 < size.z ? row + slices : row;
            for (int i = 0; i < size.x; ++i) {
                const float right = row[std::min(i + 1, size.x - 1)];
                if (row[i] == right && row[i] == nextRow[i] && row[i] == nextSlice[i]) continue;
                low = glm::min(low, glm::ivec3(i, j, k));
                high = glm::max(high, glm::ivec3(i, j, k) + 1);
            }
        }
    if (high.x < 0) return {};
    return {box.first + low, glm::min(box.first + high + 1, box.end)};
}

// Smooths tiles of the lumen's surface one after the other, on one thread.
class TileSmoother {
public:
    TileSmoother(const VoxelRuns& inside, const WideSmoothing& setting, GreyVolume& field)
        : mInside(inside),
          mField(field),
          mSmoother(sigmaIn(field.frame, setting.sigma)),
          mRounds(setting.rounds),
          mMargin(static_cast<float>(2 * setting.margin / (kMaskOutside - kMaskInside))) {}

    void run(const Box& tile) {
        const glm::ivec3 reach = mSmoother.reach() * (2 * mRounds);
        const Box around = grown(tile, reach);
        fillSigns(mInside, around, mSigns);
        const Box border = borderOf(mSigns, around);
        if (border.empty()) return fillConstant(tile, mSigns[0]);
        const Box shell = common(grown(border, reach), tile);
        fillTile(tile);
        if (shell.empty()) return;
        smoothShell(grown(shell, reach));
        store(shell, grown(shell, reach));
    }

private:
    static glm::dvec3 sigmaIn(const VolumeFrame& frame, double sigma) {
        const double smallest = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
        return sigma * smallest / frame.spacing;
    }

    void fillConstant(const Box& tile, float sign) {
        if (sign > 0) return;
        for (int k = tile.first.z; k < tile.end.z; ++k)
            for (int j = tile.first.y; j < tile.end.y; ++j)
                std::fill_n(&mField.at(tile.first.x, j, k), tile.size().x,
                            static_cast<std::int16_t>(kMaskInside));
    }

    void fillTile(const Box& tile) {
        for (int k = tile.first.z; k < tile.end.z; ++k)
            for (int j = tile.first.y; j < tile.end.y; ++j)
                for (const VoxelRun& run : mInside.row(j, k)) {
                    const int first = std::max(run.first, tile.first.x), end = std::min(run.end, tile.end.x);
                    for (int i = first; i < end; ++i) mField.at(i, j, k) = kMaskInside;
                }
    }

    void smoothShell(const Box& box) {
        fillSigns(mInside, box, mSigns);
        mValues = mSigns;
        for (int round = 0; round < mRounds; ++round) {
            mSmoother.smooth(mValues, box.size());
            mTwice = mValues;
            mSmoother.smooth(mTwice, box.size());
            for (std::size_t n = 0; n < mValues.size(); ++n)
                mValues[n] = mSigns[n] * std::clamp((2 * mValues[n] - mTwice[n]) * mSigns[n], mMargin, 1.0f);
        }
    }

    void store(const Box& shell, const Box& box) {
        const float middle = kMaskWall, half = (kMaskOutside - kMaskInside) / 2.0f;
        const glm::ivec3 size = box.size();
        for (int k = shell.first.z; k < shell.end.z; ++k)
            for (int j = shell.first.y; j < shell.end.y; ++j) {
                const glm::ivec3 at = glm::ivec3(shell.first.x, j, k) - box.first;
                const float* row =
                    mValues.data() + (static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x;
                std::int16_t* to = &mField.at(shell.first.x, j, k);
                for (int i = 0; i < shell.size().x; ++i)
                    to[i] = static_cast<std::int16_t>(std::lround(middle + half * row[i]));
            }
    }

    const VoxelRuns& mInside;
    GreyVolume& mField;
    BoxSmoother mSmoother;
    int mRounds;
    float mMargin;
    std::vector<float> mSigns, mValues, mTwice;
};

}  // namespace

void smoothMask(const VoxelRuns& inside, const WideSmoothing& setting, GreyVolume& field,
                Progress& progress) {
    const glm::ivec3 size = inside.size, tiles = (size + (kTile - 1)) / kTile;
    ProgressSteps rows(progress, static_cast<std::size_t>(tiles.y) * tiles.z, "smoothing the wall");
    parallelFor(tiles.y * tiles.z, [&](int n) {
        if (progress.cancelled()) throw Cancelled();
        TileSmoother smoother(inside, setting, field);
        const glm::ivec2 row(n % tiles.y, n / tiles.y);
        for (int x = 0; x < tiles.x; ++x) {
            const Box tile{{x * kTile, row.x * kTile, row.y * kTile},
                           glm::min(glm::ivec3(x + 1, row.x + 1, row.y + 1) * kTile, size)};
            smoother.run(tile);
        }
        rows.done();
    });
}

}  // namespace stereonav
