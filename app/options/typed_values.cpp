#include "app/options/typed_values.h"

#include <cmath>
#include <vector>

#include "app/options/option_numbers.h"
#include "engine/math/constants.h"
#include "engine/text/number.h"

namespace stereonav {

glm::dvec3 colorOf(const OptionValue& value) {
    return value.numbers.size() == 1 ? glm::dvec3(value.number()) : placeOf(value);
}

glm::dvec3 placeOf(const OptionValue& value) {
    return {value.numbers[0], value.numbers[1], value.numbers[2]};
}

LightPlace lightPlaceOf(const OptionValue& value) {
    return {std::remainder(value.numbers[0], 360.0) * kRadians, value.numbers[1] * kRadians};
}

Pose poseOf(const OptionValue& value) {
    std::vector<double> n = value.numbers;
    n.resize(6);  // missing angles are 0
    return poseFromAngles({n[0], n[1], n[2]}, n[3] * kRadians, n[4] * kRadians, n[5] * kRadians);
}

LampsAsked lampsOf(const OptionValue& value) {
    LampsAsked lamps;
    lamps.centreline = value.word == kCentrelineLights;
    if (lamps.centreline) {
        if (!value.numbers.empty()) lamps.spacing = value.number();
        return lamps;
    }
    lamps.position = placeOf(value);
    if (value.numbers.size() == 4) lamps.intensity = value.numbers[3];
    return lamps;
}

LightChoice lightChoiceOf(const OptionValue& value) {
    using Kind = LightChoice::Kind;
    if (value.text == "plain") return {Kind::Plain, ""};
    if (value.text == "auto") return {Kind::Auto, ""};
    if (value.text == "lazy") return {Kind::Lazy, ""};
    if (value.text == "lazy-transfer") return {Kind::LazyTransfer, ""};
    if (value.text == "traced") return {Kind::Traced, ""};
    return {Kind::File, value.text};
}

double bytesOfMemoryText(const std::string& text) {
    constexpr double kLeast = 10e6;
    std::string number = text;
    double unit = 1;
    if (!number.empty()) {
        const char last = number.back();
        unit = last == 'G' ? 1e9 : last == 'M' ? 1e6 : last == 'k' ? 1e3 : 1;
        if (unit > 1) number.pop_back();
    }
    const auto value = numberOf(number);
    const double bytes = value ? *value * unit : 0;
    return bytes >= kLeast && std::isfinite(bytes) ? bytes : 0;
}

std::optional<ValueProblem> problemOfMemory(const std::string& text) {
    if (bytesOfMemoryText(text) > 0) return std::nullopt;
    return ValueProblem{"expected bytes, 10 MB or more, got \"" + text + "\"", "write 2G, 500M or 2e9"};
}

UpAxis upAxisOf(const OptionValue& value) {
    return upAxisFromText(value.text).value_or(UpAxis{});
}

}  // namespace stereonav
