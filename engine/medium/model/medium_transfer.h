// Optical properties by value and by gradient magnitude (Kniss et al. 2003, section 3.3; row K5 of
// docs/ledger.md). In one dimension: points over the value, linear between them. In two: regions over value
// and gradient magnitude, added up by extinction.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/medium/model/optical_properties.h"

namespace stereonav {

// A material in its text form: opacity and transport colour of a layer of the file's reference length.
struct MediumMaterial {
    glm::vec3 color{1.0f};      // linear RGB 0..1
    double opacity = 0;         // 0..1; 1 counts as kDensest
    glm::vec3 transport{0.5f};  // linear RGB 0..1: colour of scattered light after that layer, 1 - alpha_i
    double surface = 0;         // weight 0..1
    glm::vec3 glow{0.0f};       // linear RGB, >= 0
};
struct MediumPoint {
    double value = 0;  // in the field's units
    MediumMaterial material;
};
// Weight 1 inside, falling linearly to 0 over the outer parts: a trapezoid in value and one in gradient.
struct MediumRegion {
    double value[4] = {};  // A < B <= C < D: the weight is 0, 1, 1, 0 there
    // Corners A, B, C and D for the gradient magnitude, value units per metre. A = B = 0: from 0 on; the last
    // may be infinite.
    double gradient[4] = {};
    MediumMaterial material;
};

// The transfer function of a medium; renderers read it as a MediumTable.
class MediumTransfer {
public:
    static constexpr double kDensest = 1.0 - 1e-6;  // largest opacity

    MediumTransfer() = default;
    // Throws Error (named `source`, with the place) unless all is finite, ordered and in range and
    // referenceLength > 0 (metres).
    MediumTransfer(std::vector<MediumPoint> points, double referenceLength, const std::string& source);
    MediumTransfer(std::vector<MediumRegion> regions, double referenceLength, const std::string& source);

    bool empty() const { return mPoints.empty() && mRegions.empty(); }
    bool usesGradient() const { return !mRegions.empty() || hasSurfaceRamp(); }
    double referenceLength() const { return mReferenceLength; }
    const std::vector<MediumPoint>& points() const { return mPoints; }
    const std::vector<MediumRegion>& regions() const { return mRegions; }

    // Multiplies every surface weight by a share that rises from 0 at gradient magnitude `low` to 1 at `high`
    // (value units per metre), so that smooth interiors keep their volume light. Throws Error unless 0 <= low
    // < high.
    void setSurfaceRamp(double low, double high, const std::string& source);
    bool hasSurfaceRamp() const { return mSurfaceHigh > 0; }
    double surfaceLow() const { return mSurfaceLow; }
    double surfaceHigh() const { return mSurfaceHigh; }

    // Returns the properties at a value and gradient magnitude (value units per metre). Extinctions, which
    // are logarithms of opacity, are added, and are linear between points; colours are averaged by
    // extinction. Where the opacity is 0 all properties are 0.
    OpticalProperties at(double value, double gradient) const;
    // Returns the range of values outside which the medium is transparent for every gradient; lowest >
    // highest where it is everywhere; ends may be infinite.
    struct Range {
        double lowest, highest;  // values
    };
    Range visibleRange() const;
    Range changingRange() const;  // range of values outside which properties are constant
    // Returns the gradient in value units per metre above which properties are constant; 0 in one dimension.
    double largestGradient() const;

private:
    std::vector<MediumPoint> mPoints;
    std::vector<MediumRegion> mRegions;
    double mReferenceLength = 0.001;           // metres
    double mSurfaceLow = 0, mSurfaceHigh = 0;  // value units a metre; both 0: no ramp
};

// Returns the transport colour, linear RGB 0..1, that diffusion gives to a material of this colour and
// opacity (docs/formats.md), for files without one.
glm::vec3 diffuseTransport(const glm::vec3& color, double opacity);

// Read the text format of docs/formats.md. Throw Error with file and line.
MediumTransfer parseMediumTransfer(std::string_view text, const std::string& source);
MediumTransfer readMediumTransfer(const std::filesystem::path& file);

// The files of data/medium, which are part of the program.
struct MediumPreset {
    std::string_view name;
    std::string_view text;
};
std::span<const MediumPreset> mediumPresets();
std::string mediumPresetNames();  // "a, b, c"
// Reads a file, or else takes the preset with this name. Throws Error that lists the names.
MediumTransfer findMediumTransfer(const std::filesystem::path& fileOrName);

}  // namespace stereonav
