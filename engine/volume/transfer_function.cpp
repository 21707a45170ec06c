// Piecewise linear colour and opacity, and the text file it is kept in.
#include "engine/volume/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/packed_color.h"
#include "engine/math/constants.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

bool isShare(double x) {
    return x >= 0 && x <= 1;  // false for NaN
}

// Returns what is wrong with the point that follows `previous` (null: none), "" when nothing.
std::string problemOf(const TransferPoint& point, const TransferPoint* previous) {
    if (!std::isfinite(point.value)) return fmt::format("expected a finite value, got {}", point.value);
    for (int c = 0; c < 3; ++c)
        if (!isShare(point.color[c]))
            return fmt::format("expected a colour in 0 to 1, got {}", point.color[c]);
    if (!isShare(point.opacity)) return fmt::format("expected an opacity in 0 to 1, got {}", point.opacity);
    if (previous && !(point.value > previous->value))
        return fmt::format("expected a value above {}, got {}", previous->value, point.value);
    return "";
}

constexpr const char* kPointAdvice =
    "give one point a line as \"value red green blue opacity\", values ascending, the rest in 0 to 1";

void checkLength(double metres, const std::string& source, const std::string& place) {
    if (!(metres > 0 && std::isfinite(metres)))
        throw Error(source, place,
                    fmt::format("expected a positive reference length, got {} mm", metres * 1e3),
                    "give the thickness of the layer that opacities are for, \"reference_mm 1\"");
}

void checkPoint(const std::vector<TransferPoint>& points, std::size_t n, const std::string& source,
                const std::string& place) {
    const std::string problem = problemOf(points[n], n > 0 ? &points[n - 1] : nullptr);
    if (!problem.empty()) throw Error(source, place, problem, kPointAdvice);
}

// Reads the lines of one file, each checked where it stands.
class Parser {
public:
    explicit Parser(std::string source) : mSource(std::move(source)) {}

    void line(std::string_view text) {
        ++mLine;
        const auto words = wordsOf(withoutComment(text));
        if (words.empty()) return;
        if (words[0] == "reference_mm") {
            readLength(words);
        } else {
            readPoint(words);
        }
    }

    TransferFunction finish() {
        if (mPoints.empty())
            throw Error(mSource, "", "expected at least one point, found none", kPointAdvice);
        return TransferFunction(std::move(mPoints), mLength > 0 ? mLength : 0.001, mSource);
    }

private:
    std::string place() const { return std::to_string(mLine); }

    double number(std::string_view word) const {
        const std::optional<double> value = numberOf(word);
        if (!value)
            throw Error(mSource, place(), fmt::format("expected a number, got \"{}\"", word.substr(0, 40)),
                        kPointAdvice);
        return *value;
    }

    void readLength(const std::vector<std::string_view>& words) {
        if (words.size() != 2)
            throw Error(mSource, place(),
                        fmt::format("expected 1 number after \"reference_mm\", got {}", words.size() - 1),
                        "write \"reference_mm 1\"");
        if (mLength > 0) throw Error(mSource, place(), "\"reference_mm\" is given twice", "keep one of them");
        const double metres = number(words[1]) / 1e3;
        checkLength(metres, mSource, place());
        mLength = metres;
    }

    void readPoint(const std::vector<std::string_view>& words) {
        if (words.size() != 5)
            throw Error(mSource, place(), fmt::format("expected 5 numbers, got {}", words.size()),
                        kPointAdvice);
        TransferPoint point;
        point.value = number(words[0]);
        constexpr double kLargest = std::numeric_limits<float>::max();
        for (int c = 0; c < 3; ++c)
            point.color[c] = static_cast<float>(std::clamp(number(words[c + 1]), -kLargest, kLargest));
        point.opacity = number(words[4]);
        mPoints.push_back(point);
        checkPoint(mPoints, mPoints.size() - 1, mSource, place());
        for (int c = 0; c < 3; ++c) mPoints.back().color[c] = std::min(linearFromSrgb(point.color[c]), 1.0f);
    }

    std::string mSource;
    int mLine = 0;
    double mLength = 0;  // metres; 0: not given
    std::vector<TransferPoint> mPoints;
};

}  // namespace

TransferFunction::TransferFunction(std::vector<TransferPoint> points, double referenceLength,
                                   const std::string& source)
    : mPoints(std::move(points)), mReferenceLength(referenceLength) {
    for (std::size_t n = 0; n < mPoints.size(); ++n)
        checkPoint(mPoints, n, source, "point " + std::to_string(n + 1));
    checkLength(mReferenceLength, source, "reference length");
}

TransferPoint TransferFunction::at(double value) const {
    if (mPoints.empty()) return {value, glm::vec3(1.0f), 0};
    const auto above = std::upper_bound(mPoints.begin(), mPoints.end(), value,
                                        [](double v, const TransferPoint& p) { return v < p.value; });
    TransferPoint result = above == mPoints.begin() ? *above : *(above - 1);
    if (above != mPoints.begin() && above != mPoints.end()) {
        const TransferPoint& below = *(above - 1);
        // Halves: the difference of two finite numbers may be infinite.
        const double share = (value / 2 - below.value / 2) / (above->value / 2 - below.value / 2);
        result.color += (above->color - below.color) * static_cast<float>(share);
        result.opacity += (above->opacity - below.opacity) * share;
    }
    result.value = value;
    return result;
}

double TransferFunction::extinction(double value) const {
    return -std::log1p(-std::min(at(value).opacity, kDensest)) / mReferenceLength;
}

TransferFunction::Range TransferFunction::visibleRange() const {
    const auto visible = [](const TransferPoint& p) { return p.opacity > 0; };
    const auto first = std::find_if(mPoints.begin(), mPoints.end(), visible);
    if (first == mPoints.end()) return {kInfinity, -kInfinity};
    const auto last = std::find_if(mPoints.rbegin(), mPoints.rend(), visible);
    return {first == mPoints.begin() ? -kInfinity : (first - 1)->value,
            last == mPoints.rbegin() ? kInfinity : (last - 1)->value};
}

TransferFunction parseTransferFunction(std::string_view text, const std::string& source) {
    Parser parser(source);
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        parser.line(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return parser.finish();
}

TransferFunction readTransferFunction(const std::filesystem::path& file) {
    return parseTransferFunction(readTextFile(file), file.string());
}

}  // namespace stereonav
