// The ground as one of four fans around an eye: columns across the view, near ones first. Tests lines of
// sight over a few columns at a time.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>

#include "terrain/ground/heightfield.h"

namespace stereonav {

// How a line of sight passes the ground; Untold: too close to it to decide.
enum class Passing { Clear, Hidden, Untold };

class FanGround {
public:
    // eye: grid coordinates. fall: curvatureFall(), 1/metre. axis: 0 looks east (sign 1) or west (-1); 1
    // looks north or south.
    FanGround(const Heightfield& ground, const glm::dvec2& eye, double fall, int axis, int sign);

    int columns() const { return mColumns; }
    int rows() const { return mRows; }
    int sign() const { return mSign; }
    // Returns the first column at a distance of one sample spacing or more: 0 or 1. Columns before it have no
    // bounds.
    int first() const { return mNearest < 1 ? 1 : 0; }
    // Returns the distance of a column from the eye, in columns; that of column -1 is 0 or below.
    double distance(int column) const { return mNearest + column; }
    double middle() const { return mMiddle; }  // row of the eye
    double step() const { return mStep; }      // metres a column
    double across() const { return mAcross; }  // metres a row
    double fall() const { return mFall; }      // 1/metre
    // Returns (length / distance in columns)^2 along a tangent (rows per column), square metres.
    double stretch(double tangent) const { return mStep * mStep + tangent * tangent * mAcross * mAcross; }
    // Returns the sample (i, j) of the ground.
    glm::ivec2 sample(int column, int row) const {
        const int along = mStart + mSign * column;
        return mAxis == 0 ? glm::ivec2(along, row) : glm::ivec2(row, along);
    }
    // Returns the height in metres; column: -1 or more.
    float height(int column, int row) const { return mData[column * mAlongStride + row * mAcrossStride]; }
    // Returns the heights of a column from a row on. stride: set to the step from one row to the next.
    const float* row(int column, int first, std::ptrdiff_t* stride) const {
        *stride = mAcrossStride;
        return mData + column * mAlongStride + first * mAcrossStride;
    }
    // Writes 0 for each of `rows` samples that is known together with its eight neighbours, so that all cells
    // around it are known; NaN for the others.
    void firm(int column, int firstRow, int rows, float* zeros) const;

    // Returns how the line from `eye` metres above the datum to `target` metres at sample (column, row)
    // passes the ground between two columns, in the cells that SightLines would test. Untold where the ground
    // rises over the line by no more than SightLines may take for rounding, which is `grazing` metres or a
    // part of it.
    Passing passing(double eye, double target, int column, int row, int fromColumn, int toColumn,
                    double grazing) const;

private:
    const Heightfield& mGround;
    int mAxis, mSign, mRows = 0, mColumns = 0, mStart = 0;
    double mNearest = 0;                            // distance of column 0: above 0 to 1 column
    double mMiddle, mStep = 1, mAcross = 1, mFall;  // row; metres a column, a row; 1/metre
    std::ptrdiff_t mAlongStride = 0, mAcrossStride = 0;
    const float* mData = nullptr;  // metres, row 0 of column 0
};

}  // namespace stereonav
