// A part of a fan around an eye, swept outward column by column: finds bounds of its bins, and the visibility
// of its samples (method: terrain/survey/viewshed.h).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/image/plane.h"
#include "terrain/survey/fan_ground.h"
#include "terrain/survey/fan_rows.h"
#include "terrain/survey/hole_tiles.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {

// One instruction set's kernels.
struct FanKernels {
    decltype(&plain::readHeights) readHeights;
    decltype(&plain::raiseLow) raiseLow;
    decltype(&plain::raiseHigh) raiseHigh;
    decltype(&plain::tellSamples) tellSamples;
    decltype(&plain::walkSamples) walkSamples;
};

// Tests one line at a time. Its data are made for the first line that is tested, since mostly there is none.
class SingleLines {
public:
    SingleLines(const Heightfield& ground, double fall) : mGround(ground), mFall(fall) {}
    bool sees(const glm::dvec3& eye, const glm::dvec3& target) const {
        std::call_once(mOnce, [&] {
            mMaxima = HeightPyramid(mGround);
            mLines.emplace(mGround, mMaxima, mFall);
        });
        return mLines->sees(eye, target);
    }

private:
    const Heightfield& mGround;
    double mFall;  // 1/metre
    mutable std::once_flag mOnce;
    mutable HeightPyramid mMaxima;
    mutable std::optional<SightLines> mLines;
};

// Data that all parts of all fans share.
struct FanTask {
    const Heightfield& ground;
    const HoleTiles& holes;
    const SingleLines& lines;
    const FanKernels& kernels;
    glm::dvec3 eye;                    // x, y in the grid's units, z in metres
    double fall, targetHeight, reach;  // ViewshedSetting's: 1/metre, metres, metres
    double grazing;                    // metres: no line that counts as seen lies farther below the ground
    Plane<std::uint8_t>& seen;         // Seen
};

// Numbers of samples.
struct FanCounts {
    // Numbers of samples that are seen; unknown; tested over the last columns; tested over all columns;
    // tested in doubles.
    long long visible = 0, unknown = 0, near = 0, all = 0, alone = 0;
};

class FanSweep {
public:
    // Prepares one of `parts` parts of a fan, which are tasks for threads.
    FanSweep(const FanTask& task, int axis, int sign, int part, int parts);
    // Sets FanTask::seen of all samples of the part.
    FanCounts run();

private:
    static constexpr int kLag = 2;    // number of columns between the samples and the end of the upper bounds
    static constexpr int kBlock = 4;  // number of columns that share stored upper bounds

    // Rows of a column that the part may need, above the eye, with data for lower and upper bounds.
    struct Column {
        int start = 0, rows = 0;
        bool holes = false;
        float* height = nullptr;  // heights in mStore
        std::vector<float> tops;  // target of ReadRow::tops
        std::vector<float> firm;  // used where there are holes
    };

    int bins() const { return mBins; }
    double width() const { return (mTo - mFrom) / mBins; }
    void split();
    void makeStore();
    void read(int at, Column& column);
    // Returns the bins over a column that lie at least partly on the ground: first, and one past the last.
    glm::ivec2 binsOver(double x) const;
    FanBins binsAt(double x, double fallAt, const glm::ivec2& range, int start, float slack) const;
    float slackOf(int rows) const;  // rows: in a buffer, up to now
    void raiseLowAt(int at, const Column& column);
    void raiseHighAt(int at, const Column& near, const Column& far);
    double slopeBeside() const;
    void endBlock();
    void samplesAt(int at, const Column& column);
    // Returns the first and last row of a column whose samples belong to this part.
    glm::ivec2 ownRows(double x) const;
    void samplesOneByOne(int at, const glm::ivec2& rows);
    void walk(int at, const Column& column);
    void sampleAlone(int at, int row);
    Passing passingOf(int at, int row, double height) const;
    template <typename Walk>
    Passing passingOverBlocks(int at, const Walk& walk, double slope, double tangent) const;
    void see(int at, int row);
    void missing(int at, int row);
    bool withinReach(int at, int row) const;

    const FanTask& mTask;
    const Heightfield& mHeights;
    const FanGround mGround;
    double mFrom, mTo;          // tangents, rows per column
    bool mOpenFrom, mClosedTo;  // mFrom is excluded; mTo is included
    // Metres: largest height above the eye, and largest difference from row to row, in the columns so far.
    float mTallest = 0, mSteepest = 0;
    // Metres per column: upper bound of all slopes up to the first column.
    double mBeside = std::numeric_limits<double>::infinity();
    int mBins = 1;
    std::vector<float> mLow, mHigh, mEdge;  // slopes, metres per column
    std::vector<std::uint16_t> mOpen, mAbove;
    std::vector<float> mBlock;  // upper bounds of the last columns, at most kBlock of them
    // Upper bounds of the columns before, by the bins at the end of each block.
    std::vector<std::vector<float>> mKept;
    std::vector<WalkBlock> mBlocks;  // mKept, and the last one
    std::vector<float> mStore;       // heights of all columns so far, metres over the eye
    std::size_t mStored = 0;
    bool mHoles = false;  // in some column so far
    int mLastStart = 0;   // mStart of the column before
    std::vector<WalkColumn> mWalkColumns;
    std::vector<int> mWalkRows;
    std::vector<std::uint8_t> mWalkAbove, mTold;
    std::array<Column, kLag + 2> mColumns;
    FanCounts mCounts;
};

}  // namespace stereonav
