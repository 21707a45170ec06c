// A transfer function that is being edited: ordered points, with colours as on the screen. Its value is its
// text, which --transfer takes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/volume/transfer_function.h"

namespace stereonav {

struct CurvePoint {
    double value = 0;
    std::array<float, 3> color{1, 1, 1};  // sRGB, 0..1
    double opacity = 0;                   // 0..1, for a layer of the reference length
};

class TransferCurve {
public:
    // Makes a curve of the function; empty where it is empty, or has more points than a text may have.
    explicit TransferCurve(const TransferFunction& function);

    const std::vector<CurvePoint>& points() const { return mPoints; }
    bool empty() const { return mPoints.empty(); }
    bool full() const;
    double referenceLength() const { return mReferenceLength; }  // in metres
    std::string text() const;                                    // see engine/volume/transfer_text.h
    // Returns the interpolated point, like the function.
    CurvePoint at(double value) const;

    // Inserts a point with the curve's colour there, and returns its index. Where a point has exactly this
    // value, that one gets the opacity. kNone where the curve is full or empty, or the value is no number.
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t insert(double value, double opacity);
    // Moves a point, but not past its neighbours; values that are no numbers change nothing.
    void move(std::size_t index, double value, double opacity);
    void recolor(std::size_t index, const std::array<float, 3>& color);
    // Removes a point; the last one stays.
    bool remove(std::size_t index);

private:
    TransferFunction function() const;

    std::vector<CurvePoint> mPoints;
    double mReferenceLength = 0.001;
};

// Returns a ramp from 0 at `low` upwards to `high`: a beginning where named functions are for other values.
// Returns an empty curve unless low < high and both are finite.
TransferCurve rampBetween(double low, double high);

// The range of values that a curve is drawn over.
struct ValueView {
    double low = 0, high = 1;  // finite, low < high

    double shareOf(double value) const;  // 0 at low, 1 at high; finite
    double valueAt(double share) const;
    double step() const;                 // a round number, about a thousandth of the range
    double rounded(double value) const;  // to a multiple of step()
    bool operator==(const ValueView&) const = default;
};
// Returns all values from lowest to highest, and the points of a curve that are not far outside.
ValueView viewOf(double lowest, double highest, const TransferCurve& curve);
// Returns a range smaller by the factor, around a value that stays in place, within `all`; not so small that
// numbers have too few digits.
ValueView zoomed(const ValueView& view, double factor, double about, const ValueView& all);

}  // namespace stereonav
