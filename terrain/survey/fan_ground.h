// The ground as one of the four fans around an eye sees it: columns across the view, near ones first, and
// lines of sight over a few of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>

#include "terrain/ground/heightfield.h"

namespace stereonav {

enum class Passing { Clear, Hidden, Untold };

class FanGround {
public:
    // eye: grid. axis: 0 looks east (sign 1) or west (-1), 1 north or south.
    FanGround(const Heightfield& ground, const glm::dvec2& eye, double fall, int axis, int sign);

    int columns() const { return mColumns; }
    int rows() const { return mRows; }
    int sign() const { return mSign; }
    // The first column that is a sample spacing away or more: 0 or 1. Nothing before it has bounds.
    int first() const { return mNearest < 1 ? 1 : 0; }
    // Distance of a column from the eye, columns; that of column -1 is 0 or below.
    double distance(int column) const { return mNearest + column; }
    double middle() const { return mMiddle; }  // the eye's row
    double step() const { return mStep; }      // metres a column
    double across() const { return mAcross; }  // metres a row
    double fall() const { return mFall; }
    // Square metres: (length over distance in columns)^2 along a tangent.
    double stretch(double tangent) const { return mStep * mStep + tangent * tangent * mAcross * mAcross; }
    glm::ivec2 sample(int column, int row) const {
        const int along = mStart + mSign * column;
        return mAxis == 0 ? glm::ivec2(along, row) : glm::ivec2(row, along);
    }
    // column: -1 or more; the eye is on the ground.
    float height(int column, int row) const { return mData[column * mAlongStride + row * mAcrossStride]; }
    // A column from a row on, and how far one row is from the next.
    const float* row(int column, int first, std::ptrdiff_t* stride) const {
        *stride = mAcrossStride;
        return mData + column * mAlongStride + first * mAcrossStride;
    }
    // 0 for each of some samples that is known with all beside it, and so all that it is a corner of; NaN for
    // the others.
    void firm(int column, int firstRow, int rows, float* zeros) const;

    // How the line from `eye` metres up to a height in a sample of a column passes the ground between two
    // columns: its cells as SightLines would look at them. Not told where it lies lower by what SightLines
    // may take for rounding, `grazing` or a part of it.
    Passing passing(double eye, double target, int column, int row, int fromColumn, int toColumn,
                    double grazing) const;

private:
    const Heightfield& mGround;
    int mAxis, mSign, mRows = 0, mColumns = 0, mStart = 0;
    double mNearest = 0;  // distance of column 0: above 0 to 1
    double mMiddle, mStep = 1, mAcross = 1, mFall;
    std::ptrdiff_t mAlongStride = 0, mAcrossStride = 0;
    const float* mData = nullptr;
};

}  // namespace stereonav
