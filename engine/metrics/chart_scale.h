// The axis of a chart: converts values to positions along it, and has ticks.
#pragma once

#include <string>
#include <vector>

namespace stereonav {

class ChartScale {
public:
    enum class Kind {
        Linear,       // from zero, or from below it where values are negative
        Logarithmic,  // zeros have no position on it
        Automatic,    // logarithmic where all values are above 0 and the largest is 6 times the least
        Around        // from the least value to the largest, with room of 0.5 at least on either side
    };

    // Makes a scale for all values that have a position; values that are not finite are ignored. Without
    // values, or with equal ones, it covers a range around them.
    ChartScale(const std::vector<double>& values, Kind kind);

    bool logarithmic() const { return mLogarithmic; }
    // Returns a value's position: 0 at the low end, 1 at the high end; clamped to the ends, NaN to the low
    // end.
    double place(double value) const;

    struct Tick {
        double value;  // a value of the axis
        std::string text;
    };
    // Returns two to about seven ticks, all within the scale.
    std::vector<Tick> ticks() const;

private:
    void choose(double least, double most);
    double mLow = 0, mHigh = 1;  // range of the values, or of their logarithms to base 10
    bool mLogarithmic = false;
};

}  // namespace stereonav
