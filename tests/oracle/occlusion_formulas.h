// Openness from the numbers of a box, one voxel at a time in double precision: the formulas of Ruiz et al.
// 2010 as they stand, with an answer for every input. The kernels' oracle.
//
// Degenerate boxes. All values equal (minimum = maximum, variance 0): 1/2, which is what a flat wall has,
// since no surface passes. Mean at the minimum (beta 0): all but nothing lies there, 1 for every value from
// the minimum on. Mean at the maximum (beta infinite): 0 below the maximum, 1 there. A variance that rounding
// made negative counts as 0; a value that differs from the mean at variance 0 gets 0 or 1. Not finite: 1/2.
#pragma once

namespace stereonav {

// Section 3.2: t^beta, t = (value - minimum) / (maximum - minimum), beta = (mean - minimum) / (maximum -
// mean), or the one given, above 0. 0 up to the minimum (but see above), 1 from the maximum on.
double reconstructedOpenness(double value, double minimum, double maximum, double mean, double beta = 0);

// Standard deviations from the mean at which drawnInOpenness() puts its ends at most.
constexpr double kDrawnInDeviations = 3;

// The same between max(minimum, mean - 3 sigma) and min(maximum, mean + 3 sigma), or as many as given, which
// single voxels do not stretch (not in the paper). The mean is kept; what lies beyond the drawn-in ends gets
// 0 and 1. Never more than nine times as far to one side as to the other where neither end is drawn in, as
// the variance is at most (mean - minimum) (maximum - mean).
double drawnInOpenness(double value, double minimum, double maximum, double mean, double variance,
                       double deviations = kDrawnInDeviations);

// Eq. 4 with the closed approximation of erf.
double gaussianOpenness(double value, double mean, double variance);

// Penner and Mitchell 2008: the share of voxels at or above the value is at most variance / (variance +
// (value
// - mean)^2) where value > mean, else 1 (Cantelli's inequality); openness is what is left. (Ruiz et al.
// say in 4.1 that values below the mean are taken as not occluded; the bound gives the opposite, and only
// that is as dark as their pictures of it.)
double chebyshevOpenness(double value, double mean, double variance);

// Winitzki 2008, with the sign that the paper leaves out: off by at most 4e-4 of erf(x).
double errorFunction(double x);

}  // namespace stereonav
