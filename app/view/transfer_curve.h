// A transfer function while it is edited: points that stay in order, colours as the screen has them. What it
// is, is told by its text, which --transfer takes.
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
    double opacity = 0;                   // 0..1, of a layer of the reference length
};

class TransferCurve {
public:
    // Empty where the function is, or has more points than a text may have.
    explicit TransferCurve(const TransferFunction& function);

    const std::vector<CurvePoint>& points() const { return mPoints; }
    bool empty() const { return mPoints.empty(); }
    bool full() const;
    double referenceLength() const { return mReferenceLength; }  // metres
    std::string text() const;                                    // engine/volume/transfer_text.h
    // Between its points, as the function is.
    CurvePoint at(double value) const;

    // Its index; where a point has this very value already, that one's, which gets the opacity. In the colour
    // that the curve has there. kNone where it is full, empty, or the value is no number.
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t insert(double value, double opacity);
    // Not past its neighbours; what is no number changes nothing.
    void move(std::size_t index, double value, double opacity);
    void recolor(std::size_t index, const std::array<float, 3>& color);
    // One stays.
    bool remove(std::size_t index);

private:
    TransferFunction function() const;

    std::vector<CurvePoint> mPoints;
    double mReferenceLength = 0.001;
};

// Nothing at `low`, more towards `high`: to begin with where functions by name are for other values. Empty
// unless low < high, both finite.
TransferCurve rampBetween(double low, double high);

// The part of the values that a curve is drawn over.
struct ValueView {
    double low = 0, high = 1;  // finite, low < high

    double shareOf(double value) const;  // 0 at low, 1 at high; finite
    double valueAt(double share) const;
    double step() const;                 // a round number, about a thousandth of it
    double rounded(double value) const;  // to steps
    bool operator==(const ValueView&) const = default;
};
// All values from lowest to highest, with the points of a curve, where they are not far beyond.
ValueView viewOf(double lowest, double highest, const TransferCurve& curve);
// Smaller by the factor about a value that stays where it is, within `all`; not so small that numbers end.
ValueView zoomed(const ValueView& view, double factor, double about, const ValueView& all);

}  // namespace stereonav
