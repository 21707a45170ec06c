// The shape of the built-in colon as an implicit function: a tube around a winding line after a textbook's
// colon, with haustral folds and polyps. Millimetres here, in the patient's axes (x to the left, y to the
// back, z to the head) around the middle of the study. Sampled by built_in_colon.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "colon/built_in/built_in_colon.h"

namespace stereonav {

// A place on the axis, every millimetre.
struct AxisPoint {
    glm::dvec3 place{0.0}, tangent{0.0};  // mm; unit
    glm::dvec3 across{0.0}, over{0.0};    // unit, with the tangent a frame that does not twist
    glm::dvec2 turn{1, 0};                // cosine and sine of the taeniae's turn about the axis
    glm::dvec3 bend{0.0};                 // the curvature vector, 1/mm
    double radius = 0;                    // mm, of the wall between folds
    double slope = 0;                     // change of the radius, mm a mm
};

// A crescent in one of three sectors between the taeniae.
struct Fold {
    double along = 0;      // mm along the axis
    double unbent = 0;     // mm, the same where the axis is not bent
    double cosine = 1;     // angle of the sector's middle, in the axis' frame
    double sine = 0;       // sine of the same angle
    double height = 0;     // mm, of the crest's middle over the wall
    double thickness = 0;  // mm
    double lean = 0;       // mm along the axis from one side to the other
};

// A polyp, and its shape.
struct BuiltInPolyp {
    Polyp data;  // in metres
    // Millimetres: the head is an ellipsoid of revolution, flattened along `inward` (unit), on a stalk of
    // this length (0: none) from `foot`.
    glm::dvec3 head{0.0}, foot{0.0}, inward{0.0};
    double across = 0, height = 0, stalk = 0;  // half axes, length
};

// Fluid stands along this part of the axis where y is larger than the level.
struct FluidLevel {
    double from = 0, to = 0;  // mm along the axis
    double y = 0;             // mm
};

class BuiltInAnatomy {
public:
    // gap: mm that walls between neighbouring loops are thick at least. bend: mm; inflation:
    // BuiltInColonSetting's.
    BuiltInAnatomy(std::uint64_t seed, double gap, double bend = 0, double inflation = 1);

    const std::vector<AxisPoint>& axis() const { return mAxis; }
    const std::vector<BuiltInPolyp>& polyps() const { return mPolyps; }
    const FluidLevel& fluid() const { return mFluid; }
    double length() const { return static_cast<double>(mAxis.size() - 1); }  // mm

    struct Place {
        double wall;   // mm to the wall, about; negative in the lumen
        double along;  // mm along the axis
    };
    // Returns the place of p by the axis point that is nearest (by distance less radius) of some, given by
    // number.
    Place placeOf(const glm::dvec3& p, const int* candidates, int count) const;
    Place placeOf(const glm::dvec3& p) const;  // by the nearest of all

private:
    void makeAxis(std::uint64_t seed, double bend, double inflation);
    double unbentLength() const { return static_cast<double>(mBent.size() - 1); }
    double bentAlong(double along) const;
    void makeRoom(double gap);
    void smoothRadii();
    void makeFluid();
    void makeFrames();
    void makeFolds(std::uint64_t seed);
    void makePolyps(std::uint64_t seed);
    void addPolyp(double along, double angle, PolypShape shape, double diameter);
    double roomAt(const Fold& fold) const;
    double foldsAt(const AxisPoint& point, double along, const glm::dvec3& to, double cosine, double sine,
                   double radius) const;
    double polypsAt(const glm::dvec3& p, double along) const;
    int nearest(const glm::dvec3& p, const int* candidates, int count) const;
    AxisPoint axisAt(double along) const;
    double footOf(const glm::dvec3& p, int nearest) const;

    std::vector<AxisPoint> mAxis;
    // Millimetres along this axis, by millimetre of the unbent one.
    std::vector<double> mBent;
    std::vector<Fold> mFolds;               // by `along`
    std::vector<std::array<int, 2>> mNear;  // for each axis point: its folds, from and to
    std::vector<BuiltInPolyp> mPolyps;
    FluidLevel mFluid;
};

}  // namespace stereonav
