#include "app/scene/terrain/ground_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "engine/text/length_text.h"
#include "terrain/survey/ground_line.h"

namespace stereonav {

std::vector<GroundFigure> figuresOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world) {
    const LineMeasure m = measureLine(ground, world), e = errorsOfLine(ground, world, m);
    return {{"plan_m", "over the plan", "m", m.plan, 0},
            {"straight_m", "straight", "m", m.straight, e.straight},
            {"along_m", "along the ground", "m", m.along, e.along},
            {"rise_m", "height difference", "m", m.rise, e.rise},
            {"climb_m", "climb", "m", m.climb, e.climb},
            {"descent_m", "descent", "m", m.descent, e.descent},
            {"lowest_m", "lowest", "m", m.lowest, e.lowest},
            {"highest_m", "highest", "m", m.highest, e.highest}};
}

std::vector<GroundFigure> figuresOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                                        const std::optional<double>& given, const ShareDone& done) {
    // Measuring takes ten times as long as finding the lowest ground, and the errors as long again.
    const auto between = [&done](double from, double to) {
        return done ? ShareDone([&done, from, to](double share) { done(from + (to - from) * share); }) : done;
    };
    const double plane = given ? *given : lowestInArea(ground, world, between(0, 0.05));
    const AreaMeasure m = measureArea(ground, world, plane, between(0.05, 0.52)),
                      e = errorsOfArea(ground, world, plane, m, between(0.52, 1));
    return {{"area_m2", "area over the plan", "m2", m.plan, 0},
            {"surface_m2", "area along the ground", "m2", m.along, e.along},
            {"perimeter_m", "border over the plan", "m", m.perimeter, 0},
            {"plane_m", "plane", "m", plane, 0},
            {"above_m3", "volume over it", "m3", m.above + 0.0, e.above},
            {"below_m3", "volume under it", "m3", m.below + 0.0, e.below},
            {"lowest_m", "lowest", "m", m.lowest, e.lowest},
            {"highest_m", "highest", "m", m.highest, e.highest}};
}

std::string figureText(const GroundFigure& figure) {
    constexpr double kKilometres = 10'000;  // metres from which on lengths are in km
    const std::string_view unit = figure.unit;
    const SizedUnit sized = unit == "m2"                            ? areaUnit(figure.value)
                            : unit == "m3"                          ? volumeUnit(figure.value)
                            : std::abs(figure.value) >= kKilometres ? lengthUnit(figure.value)
                                                                    : SizedUnit{1, figure.unit};
    if (sized.size == 1)
        return fmt::format("{} {}{}", fixedText(figure.value, 1), figure.unit, errorText(figure));
    constexpr int kDecimals = 3;
    const GroundFigure shown{figure.key, figure.label, sized.name, figure.value / sized.size,
                             figure.error / sized.size};
    const bool tiny = shown.error > 0 && shown.error < 0.0005;
    return fmt::format("{} {}{}", fixedText(shown.value, kDecimals), sized.name,
                       tiny ? " +- less than 0.001" : errorText(shown));
}

// Returns the error with two digits, without an exponent: "+- 210", not "2.1e+02".
std::string errorText(const GroundFigure& figure) {
    constexpr double kNoExponent = 1e15;
    if (figure.error == 0) return "";
    if (!std::isfinite(figure.error)) return " (error not known)";
    if (!(figure.error >= 99.5 && figure.error < kNoExponent)) return fmt::format(" +- {:.2g}", figure.error);
    const double step = std::pow(10.0, std::floor(std::log10(figure.error)) - 1);
    return fmt::format(" +- {:.0f}", std::round(figure.error / step) * step);
}

}  // namespace stereonav
