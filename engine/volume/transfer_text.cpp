#include "engine/volume/transfer_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/image/packed_color.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {

constexpr std::string_view kCurve = "curve:", kLength = "reference_mm";
constexpr double kMillimetre = 0.001;
constexpr const char* kCurveAdvice =
    "write curve:VALUE:RED:GREEN:BLUE:OPACITY,... with values ascending and the rest in 0 to 1";

std::vector<std::string_view> partsOf(std::string_view text, char between) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t end = std::min(text.find(between, from), text.size());
        parts.push_back(text.substr(from, end - from));
        from = end + 1;
    }
    return parts;
}

// Reads what stands between two commas.
class CurvePart {
public:
    CurvePart(std::string_view text, std::size_t number, const std::string& source)
        : mWords(partsOf(text, ':')), mPlace(fmt::format("part {}", number)), mSource(source) {}

    [[noreturn]] void fail(const std::string& problem) const {
        throw Error(mSource, "", mPlace + ": " + problem, kCurveAdvice);
    }
    bool isLength() const { return mWords[0] == kLength; }
    double length() const {
        if (mWords.size() != 2)
            fail(fmt::format("expected 1 number after \"{}\", got {}", kLength, mWords.size() - 1));
        const double metres = number(1) / 1e3;
        if (!(metres > 0 && std::isfinite(metres)))
            fail(fmt::format("expected a positive reference length, got {} mm", mWords[1].substr(0, 40)));
        return metres;
    }
    TransferPoint point(const TransferPoint* previous) const {
        if (mWords.size() != 5) fail(fmt::format("expected 5 numbers, got {}", mWords.size()));
        TransferPoint point;
        point.value = number(0);
        if (!std::isfinite(point.value)) fail(fmt::format("expected a finite value, got {}", point.value));
        if (previous && !(point.value > previous->value))
            fail(fmt::format("expected a value above {}, got {}", previous->value, point.value));
        for (int c = 0; c < 3; ++c)
            point.color[c] =
                std::min(linearFromSrgb(static_cast<float>(share(static_cast<std::size_t>(c) + 1))), 1.0f);
        point.opacity = share(4);
        return point;
    }

private:
    double number(std::size_t word) const {
        const std::optional<double> value = numberOf(mWords[word]);
        if (!value) fail(fmt::format("expected a number, got \"{}\"", mWords[word].substr(0, 40)));
        return *value;
    }
    double share(std::size_t word) const {
        const double value = number(word);
        if (!(value >= 0 && value <= 1))
            fail(fmt::format("expected {} in 0 to 1, got {}", word == 4 ? "an opacity" : "a colour", value));
        return value;
    }

    std::vector<std::string_view> mWords;
    std::string mPlace;
    const std::string& mSource;
};

// Returns a channel's sRGB value to four digits behind the point, without zeros at the end.
std::string colorText(float linear) {
    const float srgb = std::clamp(srgbFromLinear(linear), 0.0f, 1.0f);
    return fmt::format("{}", std::round(static_cast<double>(srgb) * 1e4) / 1e4);
}

}  // namespace

bool isCurveText(std::string_view text) {
    return text.starts_with(kCurve);
}

TransferFunction transferFromCurve(std::string_view text, const std::string& source) {
    text.remove_prefix(std::min(kCurve.size(), text.size()));
    std::vector<TransferPoint> points;
    std::optional<double> length;
    std::size_t number = 0;
    for (const std::string_view words : partsOf(text, ',')) {
        const CurvePart part(words, ++number, source);
        if (part.isLength()) {
            if (length) part.fail(fmt::format("\"{}\" is given twice", kLength));
            length = part.length();
            continue;
        }
        if (points.size() == kMostCurvePoints)
            throw Error(source, "", fmt::format("expected at most {} points in a curve", kMostCurvePoints),
                        "write them into a file, and name that");
        points.push_back(part.point(points.empty() ? nullptr : &points.back()));
    }
    if (points.empty()) throw Error(source, "", "expected at least one point, found none", kCurveAdvice);
    return {std::move(points), length.value_or(kMillimetre), source};
}

std::string curveTextOf(const TransferFunction& function) {
    std::string text;
    const std::string length = fmt::format("{:.9g}", function.referenceLength() * 1e3);
    if (length != "1") text = fmt::format("{}:{}", kLength, length);
    for (const TransferPoint& p : function.points())
        text += fmt::format("{}{}:{}:{}:{}:{}", text.empty() ? "" : ",", p.value + 0.0, colorText(p.color.x),
                            colorText(p.color.y), colorText(p.color.z), p.opacity + 0.0);
    return std::string(kCurve) + text;
}

}  // namespace stereonav
