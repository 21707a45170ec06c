#include "terrain/survey/sight_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "terrain/survey/ground_samples.h"

namespace stereonav {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The line from eye to target, by its share s in 0..1. What lies below it is measured against a straight line
// by lifting the ground between both ends: fall * D^2 * s * (1 - s).
struct Line {
    glm::dvec2 start, step, inverse;  // grid; one over the step
    double height, rise;              // metres
    double bulge;                     // fall * D^2

    Line(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec2& spacing, double fall)
        : start(eye),
          step(glm::dvec2(target) - glm::dvec2(eye)),
          inverse(1.0 / step),
          height(eye.z),
          rise(target.z - eye.z) {
        const glm::dvec2 run = step * spacing;
        bulge = fall * glm::dot(run, run);
    }
    // Height of the line over ground that is not lifted.
    double at(double s) const { return height + s * rise - bulge * s * (1 - s); }
    // No more than at() anywhere between: it is convex.
    double leastOver(double from, double to) const {
        return std::min(at(from), at(to)) - 0.25 * bulge * (to - from) * (to - from);
    }
    // Returns the share of the line at which it leaves a column (axis 0) or row of blocks.
    double leaves(int axis, int block, int level) const {
        if (step[axis] == 0) return kInfinite;
        return ((step[axis] > 0 ? (block + 1) << level : block << level) - start[axis]) * inverse[axis];
    }
};

// How far the ground rises over the line inside a cell: most, and where.
struct Rise {
    double most = -kInfinite, at = 0;
};

template <typename Ground>
Rise riseInCell(const Ground& ground, const Line& line, int i, int j, double from, double to) {
    const double a = ground.sample(i, j), b = ground.sample(i + 1, j);
    const double c = ground.sample(i, j + 1), d = ground.sample(i + 1, j + 1);
    const double twist = a - b - c + d;
    if (!std::isfinite(twist)) return {};  // open
    const auto over = [&](double s) {
        const double u = line.start.x - i + s * line.step.x, v = line.start.y - j + s * line.step.y;
        return a + (b - a) * u + (c - a) * v + twist * u * v - line.at(s);
    };
    const double first = over(from), last = over(to);
    Rise rise = first > last ? Rise{first, from} : Rise{last, to};
    // first + (last - first) * t + bend * t * (t - 1)
    const double bend = (twist * line.step.x * line.step.y - line.bulge) * (to - from) * (to - from);
    if (bend >= 0) return rise;
    const double t = 0.5 - 0.5 * (last - first) / bend;
    if (!(t > 0 && t < 1)) return rise;
    const double top = first + (last - first) * t + bend * t * (t - 1);
    if (top > rise.most) rise = {top, from + t * (to - from)};
    return rise;
}

// Stands in the place of a HeightPyramid: every cell may be higher than any line.
struct NoMaxima {
    static int levelCount() { return 1; }
    static double at(int, int, int) { return kInfinite; }
};

// The cells that the line crosses between two shares of it, over blocks of the maxima.
template <typename Maxima>
class Walk {
public:
    template <typename Ground>
    Walk(const Ground& ground, const Maxima& maxima, const Line& line, double from, double to)
        : mMaxima(maxima), mLine(line), mS(from), mTo(to) {
        mLast[0] = ground.width() - 2, mLast[1] = ground.height() - 2;
        for (const int axis : {0, 1}) mCell[axis] = cellAt(axis, 0, mLast[axis]);
    }
    // Comes to the next cell over which the line is less than `room` above the maxima (below 0: under them);
    // false at the end.
    bool next(double room) {
        if (mStarted && !leave(mOut)) return false;
        mStarted = true;
        for (;;) {
            const int x = mCell[0] >> mLevel, y = mCell[1] >> mLevel;
            mOutX = mLine.leaves(0, x, mLevel), mOutY = mLine.leaves(1, y, mLevel);
            mOut = std::max(mS, std::min({mOutX, mOutY, mTo}));
            if (mLine.leastOver(mS, mOut) - mMaxima.at(mLevel, x, y) < room) {
                if (mLevel == 0) return true;
                --mLevel;
                continue;
            }
            if (!leave(mOut)) return false;
            if (mLevel + 1 < mMaxima.levelCount()) ++mLevel;
        }
    }
    int i() const { return mCell[0]; }
    int j() const { return mCell[1]; }
    double from() const { return mS; }
    double to() const { return mOut; }

private:
    // Returns the cell of the present place; at a border, the cell that lies ahead.
    int cellAt(int axis, int low, int high) const {
        const double p = mLine.start[axis] + mS * mLine.step[axis];
        const double k = std::floor(p) - (p == std::floor(p) && mLine.step[axis] < 0 ? 1 : 0);
        return static_cast<int>(std::clamp(k, double(low), double(high)));
    }
    // Across the border of the block that is met first; along the other axis the block is not left.
    bool leave(double out) {
        if (out >= mTo) return false;
        mS = out;
        const int across = mOutX <= mOutY ? 0 : 1, along = 1 - across;
        const int block = mCell[across] >> mLevel, beside = mCell[along] >> mLevel;
        mCell[across] = mLine.step[across] > 0 ? (block + 1) << mLevel : (block << mLevel) - 1;
        mCell[along] = cellAt(along, beside << mLevel, std::min(((beside + 1) << mLevel) - 1, mLast[along]));
        return mCell[across] >= 0 && mCell[across] <= mLast[across];
    }

    const Maxima& mMaxima;
    const Line& mLine;
    double mS, mTo, mOut = 0, mOutX = 0, mOutY = 0;
    int mCell[2], mLast[2], mLevel = 0;
    bool mStarted = false;
};

// Returns a bound of the rounding of heights and of their differences.
double roundingOf(double tallest, const Line& line) {
    constexpr double kRoundings = 64;
    return kRoundings * std::numeric_limits<double>::epsilon() *
           (tallest + std::abs(line.height) + std::abs(line.rise) + line.bulge);
}

double tallestOf(double low, double high) {
    return std::max(std::abs(low), std::abs(high));
}

template <typename Ground, typename Maxima>
Sight measuredSight(const Ground& ground, const Maxima& maxima, double tallest, const Line& line) {
    Rise worst;
    Walk walk(ground, maxima, line, 0, 1);
    while (walk.next(-worst.most)) {
        const Rise rise = riseInCell(ground, line, walk.i(), walk.j(), walk.from(), walk.to());
        if (rise.most > worst.most) worst = rise;
    }
    return {worst.most <= roundingOf(tallest, line), -worst.most,
            worst.at * glm::length(line.step * ground.spacing())};
}

}  // namespace

SightLines::SightLines(const Heightfield& ground, const HeightPyramid& maxima, double fall)
    : mGround(ground),
      mMaxima(maxima),
      mFall(fall),
      mTallest(tallestOf(ground.minHeight(), ground.maxHeight())) {}

bool SightLines::clear(const glm::dvec3& eye, const glm::dvec3& target, double from, double to) const {
    const Line line(eye, target, mGround.spacing(), mFall);
    const double grazing = roundingOf(mTallest, line);
    Walk walk(mGround, mMaxima, line, from, to);
    while (walk.next(-grazing))
        if (riseInCell(mGround, line, walk.i(), walk.j(), walk.from(), walk.to()).most > grazing)
            return false;
    return true;
}

double SightLines::grazing(const glm::dvec2& eye, double eyeHeight, double targetHeight) const {
    double most = 0;
    for (const int i : {0, mGround.width() - 1})
        for (const int j : {0, mGround.height() - 1})
            for (const double height : {mGround.minHeight() + 0.0, mGround.maxHeight() + targetHeight})
                most = std::max(most, roundingOf(mTallest, Line({eye, eyeHeight}, {i, j, height},
                                                                mGround.spacing(), mFall)));
    return most;
}

Sight SightLines::measure(const glm::dvec3& eye, const glm::dvec3& target) const {
    return measuredSight(mGround, mMaxima, mTallest, Line(eye, target, mGround.spacing(), mFall));
}

Sight sightOver(const GroundSamples& ground, double fall, const glm::dvec3& eye, const glm::dvec3& target) {
    return measuredSight(ground, NoMaxima(), tallestOf(ground.minHeight(), ground.maxHeight()),
                         Line(eye, target, ground.spacing(), fall));
}

}  // namespace stereonav
