// See the header.
#include "tests/oracle/occlusion_formulas.h"

#include <algorithm>
#include <cmath>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr double kUndecided = 0.5;

// Returns the openness where all values lie at `place`.
double step(double value, double place) {
    return value == place ? kUndecided : value < place ? 0.0 : 1.0;
}

}  // namespace

double errorFunction(double x) {
    const double a = 8 * (kPi - 3) / (3 * kPi * (4 - kPi));
    const double square = std::min(x * x, 1e6);  // beyond 1000 the sum is 1 to the last bit
    const double exponent = square * (4 / kPi + a * square) / (1 + a * square);
    return std::copysign(std::sqrt(-std::expm1(-exponent)), x);
}

double reconstructedOpenness(double value, double minimum, double maximum, double mean, double beta) {
    if (!std::isfinite(value) || !std::isfinite(maximum - minimum) || !std::isfinite(mean)) return kUndecided;
    if (!(maximum > minimum)) return step(value, minimum);
    const double below = std::max(mean - minimum, 0.0), above = std::max(maximum - mean, 0.0);
    if (value >= maximum) return 1;
    if (value < minimum) return 0;
    if (beta > 0) return std::pow((value - minimum) / (maximum - minimum), beta);
    if (below == 0) return 1;
    if (above == 0 || value == minimum) return 0;
    return std::pow((value - minimum) / (maximum - minimum), below / above);
}

double drawnInOpenness(double value, double minimum, double maximum, double mean, double variance,
                       double deviations) {
    if (!std::isfinite(maximum - minimum) || !std::isfinite(variance)) return kUndecided;
    const double reach = deviations * std::sqrt(std::max(variance, 0.0));
    return reconstructedOpenness(value, std::max(minimum, mean - reach), std::min(maximum, mean + reach),
                                 mean);
}

double gaussianOpenness(double value, double mean, double variance) {
    if (!std::isfinite(value - mean) || !std::isfinite(variance)) return kUndecided;
    if (!(variance > 0)) return step(value, mean);
    return 0.5 * (1 + errorFunction((value - mean) / std::sqrt(variance) / std::sqrt(2.0)));
}

double chebyshevOpenness(double value, double mean, double variance) {
    if (!std::isfinite(value - mean) || !std::isfinite(variance)) return kUndecided;
    if (!(variance > 0)) return step(value, mean);
    if (value <= mean) return 0;
    const double away = (value - mean) / std::sqrt(variance);
    return std::isfinite(away * away) ? 1 - 1 / (1 + away * away) : 1;
}

}  // namespace stereonav
