#include "terrain/survey/fan_sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "terrain/survey/viewshed.h"

namespace stereonav {
namespace {

constexpr float kBelowAll = std::numeric_limits<float>::lowest();

// For a value that is neither finer nor larger than a float holds.
float floatOf(double value) {
    return static_cast<float>(value);
}

}  // namespace

FanSweep::FanSweep(const FanTask& task, int axis, int sign, int part, int parts)
    : mTask(task), mHeights(task.ground), mGround(mHeights, glm::dvec2(task.eye), task.fall, axis, sign) {
    mFrom = -1 + 2.0 * part / parts, mTo = -1 + 2.0 * (part + 1) / parts;
    mOpenFrom = axis == 1 && part == 0;
    mClosedTo = axis == 0 && part == parts - 1;
    mLow.assign(1 + FanBins::kPadding, kBelowAll);
    mHigh = mBlock = mLow;
    mBlocks.emplace_back();
    makeStore();
}

// The slope of the ground from the eye to the first column.
double FanSweep::slopeBeside() const {
    const int first = mGround.first();
    const double x = mGround.distance(first), last = mGround.rows() - 1.0;
    const auto inside = [&](double row) { return static_cast<int>(std::clamp(row, 0.0, last)); };
    const int low = inside(std::floor(mGround.middle() + std::min(0.0, x * mFrom))),
              high = inside(std::ceil(mGround.middle() + std::max(0.0, x * mTo)));
    double most = std::numeric_limits<double>::lowest();
    for (int at = -1; at <= first; ++at)
        for (int r = std::max(0, low - 1); r <= std::min(high + 1, mGround.rows() - 1); ++r)
            if (std::isfinite(mGround.height(at, r)))
                most = std::max(most, mGround.height(at, r) - mTask.eye.z);
    const double over = most + 2 * mTask.grazing;
    return over < 0 ? over / x : std::numeric_limits<double>::infinity();
}

FanCounts FanSweep::run() {
    const double reach = mTask.reach > 0 ? mTask.reach : std::numeric_limits<double>::infinity();
    const int first = mGround.first();
    if (first > 0 && mGround.columns() > 0) samplesOneByOne(0, ownRows(mGround.distance(0)));
    if (first < mGround.columns()) mBeside = slopeBeside();
    Column beside;
    for (int at = -1; at < first && mGround.columns() > 0; ++at) read(at, beside);
    for (int at = first; at < mGround.columns(); ++at) {
        const double x = mGround.distance(at);
        if (x * mGround.step() > reach) break;
        // All of the part lies on one side of the eye's row: it does not come back.
        if (mGround.middle() + x * mFrom > mGround.rows() - 1 || mGround.middle() + x * mTo < 0) break;
        while (width() * x > 1) split();
        constexpr int kKept = kLag + 2;
        Column& column = mColumns[static_cast<std::size_t>(at % kKept)];
        read(at, column);
        samplesAt(at, column);
        raiseLowAt(at, column);
        if (at - first >= kLag)
            raiseHighAt(at - kLag + 1, mColumns[static_cast<std::size_t>((at - kLag) % kKept)],
                        mColumns[static_cast<std::size_t>((at - kLag + 1) % kKept)]);
    }
    return mCounts;
}

// Each bin into two, which inherit what held for it.
void FanSweep::split() {
    for (std::vector<float>* bounds : {&mLow, &mHigh, &mBlock}) {
        std::vector<float> finer(static_cast<std::size_t>(2 * mBins) + FanBins::kPadding, kBelowAll);
        for (int b = 0; b < 2 * mBins; ++b)
            finer[static_cast<std::size_t>(b)] = (*bounds)[static_cast<std::size_t>(b / 2)];
        bounds->swap(finer);
    }
    mBins *= 2;
}

// Room for the heights of all columns.
void FanSweep::makeStore() {
    mWalkColumns.resize(static_cast<std::size_t>(mGround.columns()) + 1);
    double size = 4 * FanBins::kPadding;
    for (int at = 0; at < mGround.columns(); ++at)
        size += std::min(mGround.distance(at) * (mTo - mFrom) + 7, mGround.rows() + 0.0);
    mStore.assign(static_cast<std::size_t>(size), 0.0f);
}

void FanSweep::read(int at, Column& column) {
    // Rows more on each side than the wedge has, and what the column before it may ask for.
    const bool beside = at < mGround.first();  // the eye lies in the cells before it
    const double x = std::max(0.0, mGround.distance(at));
    const auto inside = [&](double row) {
        return static_cast<int>(std::clamp(row, 0.0, mGround.rows() - 1.0));
    };
    column.start = inside(std::floor(mGround.middle() + (beside ? -1 : x * mFrom)) - 2);
    const int end = inside(std::ceil(mGround.middle() + (beside ? 1 : x * mTo)) + 2);
    column.start = std::min(column.start, std::max(0, end - 1));
    column.rows = std::min(end, mGround.rows() - 1) - column.start + 1;
    const std::size_t size = static_cast<std::size_t>(column.rows) + FanBins::kPadding;
    column.height = mStore.data() + mStored;
    ReadRow row;
    row.ground = mGround.row(at, column.start, &row.stride);
    row.count = column.rows;
    // Across the grain each height lies in a line of memory that holds those of the next columns, too.
    constexpr int kAhead = 24;
    if (row.stride != 1 && at + kAhead < mGround.columns()) {
        row.ahead = kAhead * mGround.sign();
        row.aheadRow = (at + 1) % ReadRow::kTopRows;
    }
    row.eye = floatOf(mTask.eye.z), row.eyeRest = floatOf(mTask.eye.z - double(row.eye));
    column.tops.resize(static_cast<std::size_t>(column.rows / ReadRow::kTopRows) + 1);
    row.height = column.height, row.tops = column.tops.data();
    row.tallest = mTallest, row.steepest = mSteepest;
    mTask.kernels.readHeights(row);
    mTallest = row.tallest, mSteepest = row.steepest;
    WalkColumn& walked = mWalkColumns[static_cast<std::size_t>(at) + 1];
    walked.offset = mStored;
    walked.shift = column.start - mLastStart;
    walked.top = mGround.rows() - 2 - column.start;
    walked.x = floatOf(x);
    walked.row = floatOf(mGround.middle() + x * mFrom - column.start);
    walked.rowBefore = floatOf(mGround.middle() + std::max(0.0, x - 1) * mFrom - column.start);
    mLastStart = column.start;
    mStored += static_cast<std::size_t>(column.rows);
    // Holes in the columns beside this one count, too.
    const glm::ivec2 first = mGround.sample(at - 1, column.start - 1),
                     last = mGround.sample(at + 1, column.start + column.rows);
    column.holes = mTask.holes.any(glm::min(first, last), glm::max(first, last));
    mHoles = mHoles || column.holes;
    if (!column.holes || beside) return;
    if (column.firm.size() < size) column.firm.resize(size);
    mGround.firm(at, column.start, column.rows, column.firm.data());
    for (int k = 0; k < column.rows; ++k) column.firm[static_cast<std::size_t>(k)] += column.height[k];
}

glm::ivec2 FanSweep::binsOver(double x) const {
    const double low = (-mGround.middle() / x - mFrom) / width(),
                 high = ((mGround.rows() - 1 - mGround.middle()) / x - mFrom) / width();
    const auto bin = [&](double b) { return static_cast<int>(std::clamp(b, 0.0, double(mBins))); };
    return {bin(std::floor(low) - 1), bin(std::ceil(high) + 1)};
}

// Rows are rounded to floats of less than 2^24 of their range, heights and what curvature takes likewise.
float FanSweep::slackOf(int rows) const {
    constexpr double kRounding = 0x1p-22;
    const glm::dvec2 extent = glm::dvec2(mHeights.width(), mHeights.height()) * mHeights.spacing();
    const double fall = mGround.fall() * (extent.x * extent.x + extent.y * extent.y);
    return floatOf(kRounding * (4 * (mTallest + mTask.targetHeight) + 4 * fall + mSteepest * (rows + 8)) +
                   2 * mTask.grazing);
}

FanBins FanSweep::binsAt(double x, double fallAt, const glm::ivec2& range, int start, float slack) const {
    FanBins row;
    row.count = range.y - range.x;
    const double tangent = mFrom + range.x * width();
    row.row = floatOf(mGround.middle() + x * tangent - start);
    row.rowStep = floatOf(x * width());
    row.tangent = floatOf(tangent);
    row.tangentStep = floatOf(width());
    row.fallAlong = floatOf(mGround.fall() * fallAt * mGround.stretch(0));
    row.fallAcross = floatOf(mGround.fall() * fallAt * mGround.across() * mGround.across());
    row.slack = slack;
    return row;
}

// Whatever is in a bin, its rays have met the ground of this column.
void FanSweep::raiseLowAt(int at, const Column& column) {
    const double x = mGround.distance(at);
    const glm::ivec2 range = binsOver(x);
    if (range.y <= range.x) return;
    LowRow row;
    row.bins = binsAt(x, x, range, column.start, slackOf(column.rows));
    row.height = column.holes ? column.firm.data() : column.height;
    row.rows = column.rows;
    row.inverse = floatOf(1 / x);
    row.low = mLow.data() + range.x;
    row.tops = column.tops.data();
    mTask.kernels.raiseLow(row);
}

// No ground between two columns lies higher than their samples beside the bin.
void FanSweep::raiseHighAt(int at, const Column& near, const Column& far) {
    const double x0 = mGround.distance(at - 1), x1 = mGround.distance(at);
    if ((at - mGround.first() - 1) % kBlock == 0 && at - mGround.first() > 1) endBlock();
    const glm::ivec2 range = binsOver(x0);
    if (range.y <= range.x) return;
    mEdge.resize(static_cast<std::size_t>(range.y - range.x) + 1 + FanBins::kPadding);
    HighRow row;
    row.bins = binsAt(x1, x0, range, far.start, slackOf(std::max(near.rows, far.rows)));
    const FanBins before = binsAt(x0, x0, range, far.start, 0);
    row.nearRow = before.row, row.nearRowStep = before.rowStep;
    row.near = near.height, row.far = far.height;
    row.nearTops = near.tops.data(), row.farTops = far.tops.data();
    row.farRows = far.rows;
    row.shift = far.start - near.start;
    row.nearRows = near.rows, row.top = mGround.rows() - 2 - far.start;
    row.x = floatOf(x0);
    row.inverseNear = floatOf(1 / x0), row.inverseFar = floatOf(1 / x1);
    row.edge = mEdge.data();
    row.block = mBlock.data() + range.x, row.high = mHigh.data() + range.x;
    mTask.kernels.raiseHigh(row);
}

void FanSweep::endBlock() {
    const std::size_t bins = static_cast<std::size_t>(mBins);
    std::vector<float>& kept = mKept.emplace_back(2 * bins);
    std::copy_n(mBlock.begin(), bins, kept.begin());
    std::copy_n(mHigh.begin(), bins, kept.begin() + mBins);
    mBlocks.back() = {kept.data(), kept.data() + mBins, mBins};
    mBlocks.emplace_back();
    std::fill(mBlock.begin(), mBlock.end(), kBelowAll);
}

glm::ivec2 FanSweep::ownRows(double x) const {
    const double middle = mGround.middle(), low = x * mFrom, high = x * mTo;
    const auto after = [&](int r) { return mOpenFrom ? r - middle > low : r - middle >= low; };
    const auto before = [&](int r) { return mClosedTo ? r - middle <= high : r - middle < high; };
    int first = static_cast<int>(std::clamp(std::ceil(middle + low) - 1, 0.0, double(mGround.rows())));
    int last = static_cast<int>(std::clamp(std::floor(middle + high) + 1, -1.0, mGround.rows() - 1.0));
    while (first <= last && !after(first)) ++first;
    while (last >= first && !before(last)) --last;
    return {first, last};
}

// Takes each sample of a column too near for bounds.
void FanSweep::samplesOneByOne(int at, const glm::ivec2& rows) {
    for (int r = rows.x; r <= rows.y; ++r)
        if (!std::isfinite(mGround.height(at, r)))
            missing(at, r);
        else if (withinReach(at, r))
            sampleAlone(at, r);
}

void FanSweep::samplesAt(int at, const Column& column) {
    const double x = mGround.distance(at);
    const glm::ivec2 rows = ownRows(x);
    if (rows.y < rows.x) return;
    if (at - mGround.first() <= kLag + 1) return samplesOneByOne(at, rows);
    SampleRow row;
    row.height = column.height + (rows.x - column.start);
    row.count = rows.y - rows.x + 1;
    row.inverse = floatOf(1 / x);
    row.binStep = floatOf(1 / (x * width()));
    row.tangentStep = row.inverse;
    const double y = rows.x - mGround.middle();
    row.bin = floatOf((y - x * mFrom) / (x * width()));
    row.tangent = floatOf(y / x);
    row.fallAlong = floatOf(mGround.fall() * x * mGround.stretch(0));
    row.fallAcross = floatOf(mGround.fall() * x * mGround.across() * mGround.across());
    row.slack = slackOf(column.rows);
    row.targetHeight = floatOf(mTask.targetHeight);
    row.bins = mBins;
    row.low = mLow.data(), row.high = mHigh.data();
    const std::size_t words = static_cast<std::size_t>(row.count + 15) / 16;
    if (mOpen.size() < words) mOpen.resize(words), mAbove.resize(words);
    row.open = mOpen.data(), row.above = mAbove.data();
    mTask.kernels.tellSamples(row);
    mWalkRows.clear(), mWalkAbove.clear();
    for (std::size_t w = 0; w < words; ++w)
        for (unsigned open = mOpen[w]; open != 0; open &= open - 1) {
            const int bit = std::countr_zero(open), k = static_cast<int>(16 * w) + bit;
            if (!std::isfinite(row.height[k])) {
                missing(at, rows.x + k);
            } else if (mTask.reach <= 0 || withinReach(at, rows.x + k)) {
                mWalkRows.push_back(rows.x - column.start + k);
                mWalkAbove.push_back(mAbove[w] >> bit & 1);
            }
        }
    if (!mWalkRows.empty()) walk(at, column);
}

bool FanSweep::withinReach(int at, int row) const {
    const double x = mGround.distance(at), tangent = (row - mGround.middle()) / x;
    return mTask.reach <= 0 || x * x * mGround.stretch(tangent) <= mTask.reach * mTask.reach;
}

void FanSweep::missing(int at, int row) {
    const glm::ivec2 place = mGround.sample(at, row);
    mTask.seen.row(place.y)[place.x] = static_cast<std::uint8_t>(Seen::NoGround);
    ++mCounts.unknown;
}

void FanSweep::see(int at, int row) {
    const glm::ivec2 place = mGround.sample(at, row);
    mTask.seen.row(place.y)[place.x] = static_cast<std::uint8_t>(Seen::Visible);
    ++mCounts.visible;
}

void FanSweep::walk(int at, const Column& column) {
    const int count = static_cast<int>(mWalkRows.size());
    const double x = mGround.distance(at), across = mGround.across();
    mBlocks.back() = {mBlock.data(), mHigh.data(), mBins};
    mWalkRows.resize(mWalkRows.size() + FanBins::kPadding);
    mTold.resize(static_cast<std::size_t>(count));
    WalkRows rows;
    rows.heights = mStore.data(), rows.columns = mWalkColumns.data() + 1;
    rows.at = at, rows.first = mGround.first(), rows.lag = kLag, rows.blockLength = kBlock;
    rows.blocks = mBlocks.data(), rows.blockCount = static_cast<int>(mBlocks.size());
    rows.inverse = floatOf(1 / x), rows.tangent = floatOf(mFrom), rows.width = floatOf(1 / (mTo - mFrom));
    rows.bulgeAlong = floatOf(mGround.fall() * mGround.stretch(0));
    rows.bulgeAcross = floatOf(mGround.fall() * across * across);
    // A walk rounds more often than a bound does: rows, heights on both sides of a cell, and their bend.
    rows.targetHeight = floatOf(mTask.targetHeight), rows.slack = 2 * slackOf(column.rows);
    rows.beside = floatOf(mBeside), rows.holes = mHoles;
    rows.rows = mWalkRows.data(), rows.above = mWalkAbove.data(), rows.count = count;
    rows.told = mTold.data();
    mTask.kernels.walkSamples(rows);
    for (int k = 0; k < count; ++k) {
        const std::size_t n = static_cast<std::size_t>(k);
        ++(mWalkAbove[n] ? mCounts.near : mCounts.all);
        if (mTold[n] == kToldClear) see(at, column.start + mWalkRows[n]);
        if (mTold[n] == kUntold) sampleAlone(at, column.start + mWalkRows[n]);
    }
}

// Decides on one sample in doubles.
void FanSweep::sampleAlone(int at, int row) {
    ++mCounts.alone;
    const double height = double(mGround.height(at, row)) + mTask.targetHeight;
    const Passing passing = passingOf(at, row, height);
    if (passing == Passing::Hidden) return;
    if (passing == Passing::Untold && !mTask.lines.sees(mTask.eye, {mGround.sample(at, row), height})) return;
    see(at, row);
}

Passing FanSweep::passingOf(int at, int row, double height) const {
    const int first = mGround.first();
    const auto walk = [&](int from, int to) {
        return mGround.passing(mTask.eye.z, height, at, row, from, to, mTask.grazing);
    };
    if (at - first <= kLag + 1) return walk(-1, at);
    if (const Passing passing = walk(at - kLag, at); passing != Passing::Clear) return passing;
    const double x = mGround.distance(at), tangent = (row - mGround.middle()) / x;
    const double slope = (height - mTask.eye.z) / x - mGround.fall() * x * mGround.stretch(tangent);
    // Curvature only lowers the ground beside the eye: without it the bound holds, too.
    if (slope <= mBeside)
        if (const Passing passing = walk(-1, first); passing != Passing::Clear) return passing;
    return passingOverBlocks(at, walk, slope, tangent);
}

// Walks the blocks that reach up to the line, the last one first, until none before does.
template <typename Walk>
Passing FanSweep::passingOverBlocks(int at, const Walk& walk, double slope, double tangent) const {
    const double share = (tangent - mFrom) / (mTo - mFrom);
    int to = at - kLag;
    for (int b = static_cast<int>(mBlocks.size()) - 1; b >= 0; --b) {
        const WalkBlock& block = mBlocks[static_cast<std::size_t>(b)];
        const int bin = std::clamp(static_cast<int>(share * block.bins), 0, block.bins - 1);
        if (block.before[bin] < slope) break;
        const int from = mGround.first() + b * kBlock;
        if (block.own[bin] >= slope)
            if (const Passing passing = walk(from, to); passing != Passing::Clear) return passing;
        to = from;
    }
    return Passing::Clear;
}

}  // namespace stereonav
