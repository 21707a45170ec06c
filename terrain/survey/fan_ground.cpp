#include "terrain/survey/fan_ground.h"

#include <algorithm>

namespace stereonav {
namespace {

// A line over a fan: heights and rows by the distance in columns.
struct FanLine {
    double eye, rise;  // metres; a column
    double row, tangent;
    double bulge, reach;  // the ground is lifted by bulge * x * (reach - x)

    double heightAt(double x) const { return eye + rise * x - bulge * x * (reach - x); }
    double rowAt(double x) const { return row + tangent * x; }
};

}  // namespace

FanGround::FanGround(const Heightfield& ground, const glm::dvec2& eye, double fall, int axis, int sign)
    : mGround(ground), mAxis(axis), mSign(sign), mMiddle(eye[1 - axis]), mFall(fall) {
    const int size[2] = {ground.width(), ground.height()};
    mRows = size[1 - axis];
    // The nearest sample that is not beside or behind the eye.
    mStart = static_cast<int>(sign > 0 ? std::floor(eye[axis]) + 1 : std::ceil(eye[axis]) - 1);
    mColumns = std::max(0, sign > 0 ? size[axis] - mStart : mStart + 1);
    mNearest = sign * (mStart - eye[axis]);
    mStep = ground.spacing()[axis];
    mAcross = ground.spacing()[1 - axis];
    const std::ptrdiff_t along = axis == 0 ? 1 : size[0];
    mAlongStride = sign * along;
    mAcrossStride = axis == 0 ? size[0] : 1;
    mData = ground.data() + mStart * along;
}

bool FanGround::firm(int column, int row) const {
    const glm::ivec2 at = sample(column, row);
    for (int j = std::max(0, at.y - 1); j <= std::min(at.y + 1, mGround.height() - 1); ++j)
        for (int i = std::max(0, at.x - 1); i <= std::min(at.x + 1, mGround.width() - 1); ++i)
            if (!std::isfinite(mGround.sample(i, j))) return false;
    return true;
}

bool FanGround::clear(double eye, double target, int column, int row, int fromColumn, int toColumn,
                      double grazing) const {
    const double reach = distance(column), tangent = (row - mMiddle) / reach;
    const FanLine line{eye, (target - eye) / reach, mMiddle, tangent, mFall * stretch(tangent), reach};
    // Cell (column - 1, r), which the line crosses from x0 to x1; both ends' rows are known.
    const auto passes = [&](int at, int r, double x0, double x1, double row0, double row1) {
        const float nearLow = height(at - 1, r), farLow = height(at, r), nearHigh = height(at - 1, r + 1),
                    farHigh = height(at, r + 1);
        // The surface is nowhere above its corners, nor the line below its ends by more than its bulge. Most
        // cells need no more. One that is not known may pass here: it hides nothing.
        const double lowest =
            std::min(line.heightAt(x0), line.heightAt(x1)) - line.bulge * (x1 - x0) * (x1 - x0);
        if (std::max(std::max(nearLow, farLow), std::max(nearHigh, farHigh)) <= lowest) return true;
        const double a = nearLow, b = farLow, c = nearHigh, d = farHigh;
        const double twist = a - b - c + d, origin = distance(at - 1);
        if (!std::isfinite(twist)) return true;  // open
        const auto over = [&](double x, double y) {
            const double u = x - origin, v = y - r;
            return a + (b - a) * u + (c - a) * v + twist * u * v - line.heightAt(x);
        };
        const double first = over(x0, row0), last = over(x1, row1);
        if (std::max(first, last) > grazing) return false;
        const double bend = twist * (x1 - x0) * (row1 - row0) - line.bulge * (x1 - x0) * (x1 - x0);
        if (bend >= 0) return true;
        const double t = 0.5 - 0.5 * (last - first) / bend;
        return !(t > 0 && t < 1) || first + (last - first) * t + bend * t * (t - 1) <= grazing;
    };
    const int lastRow = mRows - 2;
    double x0 = std::max(0.0, distance(fromColumn)), row0 = line.rowAt(x0);
    for (int at = fromColumn + 1; at <= toColumn; ++at) {
        const double x1 = distance(at), row1 = at == column ? row : line.rowAt(x1);
        const double low = std::min(row0, row1), high = std::max(row0, row1);
        const int below = std::clamp(static_cast<int>(low), 0, lastRow);
        const double border = below + 1;
        if (high <= border || below == lastRow) {
            if (!passes(at, below, x0, x1, row0, row1)) return false;
        } else {
            const double x = std::clamp((border - mMiddle) / tangent, x0, x1);
            const int r0 = row0 <= row1 ? below : below + 1, r1 = row0 <= row1 ? below + 1 : below;
            if (!passes(at, r0, x0, x, row0, border) || !passes(at, r1, x, x1, border, row1)) return false;
        }
        x0 = x1, row0 = row1;
    }
    return true;
}

}  // namespace stereonav
