#include "terrain/survey/fan_ground.h"

#include <algorithm>
#include <limits>

namespace stereonav {
namespace {

// A line of sight over a fan: height and row by the distance in columns.
struct FanLine {
    double eye, rise;  // metres; a column
    double row, tangent;
    double bulge, reach;  // the ground is lifted by bulge * x * (reach - x)

    double heightAt(double x) const { return eye + rise * x - bulge * x * (reach - x); }
    double rowAt(double x) const { return row + tangent * x; }
};

constexpr double kRounding = 1e-9;  // tolerance of rows and columns

bool isWhole(double row) {
    return std::abs(row - std::round(row)) < kRounding;
}

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

void FanGround::firm(int column, int firstRow, int rows, float* zeros) const {
    // Zero times what is not known is no number, and stays so in sums.
    const std::ptrdiff_t before = -mAlongStride, after = column + 1 < mColumns ? mAlongStride : 0;
    const auto across = [&](int row) {
        const std::ptrdiff_t at = std::clamp(row, 0, mRows - 1) * mAcrossStride;
        const float* const middle = mData + column * mAlongStride + at;
        return 0.0f * (middle[before] + middle[0] + middle[after]);
    };
    float below = across(firstRow - 1), here = across(firstRow);
    for (int k = 0; k < rows; ++k) {
        const float above = across(firstRow + k + 1);
        zeros[k] = below + here + above;
        below = here, here = above;
    }
}

Passing FanGround::passing(double eye, double target, int column, int row, int fromColumn, int toColumn,
                           double grazing) const {
    const double reach = distance(column), tangent = (row - mMiddle) / reach;
    const FanLine line{eye, (target - eye) / reach, mMiddle, tangent, mFall * stretch(tangent), reach};
    // Rounding itself is less than an eighth of what is allowed for it.
    const double least = grazing / 8, most = 2 * grazing;
    // Returns whether a sample that the line runs through may hide it although the cell is open, since a cell
    // beside it has ground.
    const auto beside = [&](int at, double x, double y) {
        const int sample = static_cast<int>(std::round(y));
        return x == distance(at) && isWhole(y) && height(at, sample) - line.heightAt(x) > least - line.bulge;
    };
    // The ground over the line in cell (column - 1, r), which the line crosses from x0 to x1; both ends' rows
    // are known.
    const auto rise = [&](int at, int r, double x0, double x1, double row0, double row1) {
        constexpr double kBelow = std::numeric_limits<double>::lowest();
        const float nearLow = height(at - 1, r), farLow = height(at, r), nearHigh = height(at - 1, r + 1),
                    farHigh = height(at, r + 1);
        // The surface is nowhere above its corners, nor the line below its ends by more than its bulge. Most
        // cells need no more. One that is not known may pass here: it hides nothing.
        const double lowest =
            std::min(line.heightAt(x0), line.heightAt(x1)) - line.bulge * (x1 - x0) * (x1 - x0);
        if (std::max(std::max(nearLow, farLow), std::max(nearHigh, farHigh)) <= lowest) return kBelow;
        const double a = nearLow, b = farLow, c = nearHigh, d = farHigh;
        const double twist = a - b - c + d, origin = distance(at - 1);
        if (!std::isfinite(twist)) return beside(at - 1, x0, row0) || beside(at, x1, row1) ? most : kBelow;
        const auto over = [&](double x, double y) {
            const double u = x - origin, v = y - r;
            return a + (b - a) * u + (c - a) * v + twist * u * v - line.heightAt(x);
        };
        const double first = over(x0, row0), last = over(x1, row1), higher = std::max(first, last);
        const double bend = twist * (x1 - x0) * (row1 - row0) - line.bulge * (x1 - x0) * (x1 - x0);
        // A cell that is touched alone may be one beside those that the line crosses.
        if (x1 - x0 < kRounding) return std::min(higher, most);
        if (higher > most || bend >= 0) return higher;
        const double t = 0.5 - 0.5 * (last - first) / bend;
        return t > 0 && t < 1 ? std::max(higher, first + (last - first) * t + bend * t * (t - 1)) : higher;
    };
    const int lastRow = mRows - 2;
    double x0 = std::max(0.0, distance(fromColumn)), row0 = line.rowAt(x0);
    for (int at = fromColumn + 1; at <= toColumn; ++at) {
        const double x1 = distance(at), row1 = at == column ? row : line.rowAt(x1);
        const double low = std::min(row0, row1), high = std::max(row0, row1);
        const int below = std::clamp(static_cast<int>(low), 0, lastRow);
        const double border = below + 1;
        double over;
        if (high <= border || below == lastRow) {
            over = rise(at, below, x0, x1, row0, row1);
        } else {
            const double x = std::clamp((border - mMiddle) / tangent, x0, x1);
            const int r0 = row0 <= row1 ? below : below + 1, r1 = row0 <= row1 ? below + 1 : below;
            over = std::max(rise(at, r0, x0, x, row0, border), rise(at, r1, x, x1, border, row1));
        }
        if (over > least) return over > most ? Passing::Hidden : Passing::Untold;
        x0 = x1, row0 = row1;
    }
    return Passing::Clear;
}

}  // namespace stereonav
