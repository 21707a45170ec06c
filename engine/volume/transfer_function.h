// Colour and opacity by value, for translucent volumes.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

// Colour and opacity at one value.
struct TransferPoint {
    double value = 0;       // a volume's value (HU for CT)
    glm::vec3 color{1.0f};  // linear RGB
    double opacity = 0;     // in [0, 1]: the share that a layer of referenceLength takes away

    bool operator==(const TransferPoint&) const = default;
};

// Colour and opacity by value: linear between its points, constant beyond them.
class TransferFunction {
public:
    TransferFunction() = default;
    // Throws Error (named `source`, with the point's place) unless values are finite and strictly increasing,
    // opacities and colours in [0, 1], referenceLength > 0.
    TransferFunction(std::vector<TransferPoint> points, double referenceLength, const std::string& source);

    bool empty() const { return mPoints.empty(); }
    bool operator==(const TransferFunction&) const = default;
    const std::vector<TransferPoint>& points() const { return mPoints; }
    double referenceLength() const { return mReferenceLength; }  // metres

    TransferPoint at(double value) const;           // beyond the ends: the outermost point
    static constexpr double kDensest = 1.0 - 1e-6;  // largest opacity
    // Returns the optical depth a metre: -ln(1 - opacity) / referenceLength; opacity 1 counts as kDensest.
    double extinction(double value) const;

    // The values between which something is not transparent; lowest > highest where all is. The ends may be
    // infinite.
    struct Range {
        double lowest, highest;  // values
    };
    Range visibleRange() const;

private:
    std::vector<TransferPoint> mPoints;
    double mReferenceLength = 0.001;  // metres
};

// Reads text: "reference_mm L" and one line "value red green blue opacity" a point (sRGB and opacity 0..1), #
// for comments. Throws Error with file and line.
TransferFunction parseTransferFunction(std::string_view text, const std::string& source);
TransferFunction readTransferFunction(const std::filesystem::path& file);

}  // namespace stereonav
