#include "terrain/ground/ground_horizon.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace stereonav {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Metres until a coordinate leaves first .. first + count.
double wayOut(double start, double step, int first, int count) {
    if (step == 0) return kNever;
    return ((step > 0 ? first + count : first) - start) / step;
}

// The cell that a way along one axis begins in at a sample.
int firstCell(int sample, double step, int samples) {
    return step < 0 ? sample - 1 : std::min(sample, step > 0 ? sample : samples - 2);
}

}  // namespace

GroundHorizon::GroundHorizon(const Heightfield& ground) : mGround(ground), mMaxima(ground) {}

GroundHorizon::GroundHorizon(const Heightfield& part, const GroundHorizon& whole, const glm::dvec2& offset)
    : GroundHorizon(part) {
    mWhole = &whole;
    mOffset = offset;
}

double GroundHorizon::steepest(int i, int j, const glm::dvec2& direction) const {
    const glm::ivec2 sample(i, j), samples(mGround.width(), mGround.height());
    Way way{sample, direction / mGround.spacing(), mGround.sample(i, j)};
    const glm::ivec2 cell(firstCell(i, way.step.x, samples.x), firstCell(j, way.step.y, samples.y));
    double found = along(way, cell, 0, 0);
    // On a line of the grid the cells at its other side have the same edge, where those at this one are open.
    if (mGround.hasHoles())
        for (int axis = 0; axis < 2; ++axis)
            if (way.step[axis] == 0 && cell[axis] == sample[axis] && cell[axis] > 0) {
                glm::ivec2 other = cell;
                --other[axis];
                found = along(way, other, 0, found);
            }
    if (!mWhole) return found;
    const double out = std::min(wayOut(way.start.x, way.step.x, 0, samples.x - 1),
                                wayOut(way.start.y, way.step.y, 0, samples.y - 1));
    const Heightfield& whole = mWhole->mGround;
    way.start = whole.gridFromWorld(mGround.worldFromGrid(sample) + mOffset);
    way.step = direction / whole.spacing();
    return mWhole->along(way, glm::ivec2(glm::floor(way.start + out * way.step)), out, found);
}

double GroundHorizon::along(const Way& way, glm::ivec2 cell, double from, double found) const {
    const glm::ivec2 cells(mGround.width() - 1, mGround.height() - 1);
    const int top = mMaxima.levelCount() - 1;
    int level = 0;
    while (cell.x >= 0 && cell.y >= 0 && cell.x < cells.x && cell.y < cells.y) {
        const glm::ivec2 block(cell.x >> level, cell.y >> level);
        const bool hidden = double(mMaxima.at(level, block.x, block.y)) - way.height <= found * from;
        if (!hidden && level > 0) {
            --level;
            continue;
        }
        const int side = 1 << level;
        const double x = wayOut(way.start.x, way.step.x, block.x << level, side),
                     y = wayOut(way.start.y, way.step.y, block.y << level, side), out = std::min(x, y);
        if (!hidden) found = std::max(found, inCell(way, cell, from, out));
        // Into the next block: over the border that is met first, elsewhere within this one's width, whatever
        // rounding says.
        const glm::ivec2 low(block.x << level, block.y << level), high = low + side - 1, before = cell;
        const auto next = [&](double own, int axis) {
            if (own <= out) return way.step[axis] > 0 ? high[axis] + 1 : low[axis] - 1;
            if (own == kNever) return before[axis];
            return std::clamp(static_cast<int>(way.start[axis] + out * way.step[axis]), low[axis],
                              high[axis]);
        };
        cell = {next(x, 0), next(y, 1)};
        from = std::max(from, out);
        // A block of the next level is begun.
        if (level < top && ((before.x ^ cell.x) | (before.y ^ cell.y)) >> (level + 1) != 0) ++level;
    }
    return found;
}

double GroundHorizon::inCell(const Way& way, const glm::ivec2& cell, double from, double to) const {
    if (!(to > from)) return 0;  // a corner, or a cell at the border of a part that is left there
    const double a = mGround.sample(cell.x, cell.y), b = mGround.sample(cell.x + 1, cell.y),
                 c = mGround.sample(cell.x, cell.y + 1), d = mGround.sample(cell.x + 1, cell.y + 1);
    double found = 0;
    const auto look = [&](double way_m, double height) {
        if (way_m > 0) found = std::max(found, (height - way.height) / way_m);
    };
    const auto inside = [&](double way_m) {
        return glm::clamp(way.start + way_m * way.step - glm::dvec2(cell), 0.0, 1.0);
    };
    const auto lookAt = [&](double way_m, const glm::dvec2& at) {
        look(way_m, at.x + at.y <= 1 ? a + at.x * (b - a) + at.y * (c - a)
                                     : d + (1 - at.x) * (c - d) + (1 - at.y) * (b - d));
    };
    const glm::dvec2 first = inside(from), last = inside(to);
    lookAt(from, first);
    lookAt(to, last);
    // The diagonal from south-east to north-west.
    const double before = first.x + first.y - 1, after = last.x + last.y - 1;
    if (before * after < 0) {
        const double share = before / (before - after), x = glm::mix(first.x, last.x, share);
        look(glm::mix(from, to, share), c + x * (b - c));
    }
    return found;
}

}  // namespace stereonav
