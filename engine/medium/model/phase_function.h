// The share of light travelling in one direction that is scattered into another, by the cosine of the angle
// between them (Kniss et al. 2003, section 3.2): 1 is straight on, -1 straight back. Unlike the paper's, the
// tables are scaled: the mean over the sphere is 1 in each colour (4 pi times a normalised phase function),
// so that 1 everywhere is the isotropic one and the model's direct light is exactly single scattering.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

class PhaseFunction {
public:
    static constexpr int kEntries = 1024;  // intervals; evenly spaced in the angle, linear between

    PhaseFunction();  // 1 for every angle
    // Throws Error, naming `source`, unless every |g| <= 0.999.
    static PhaseFunction henyeyGreenstein(const glm::vec3& g, const std::string& source = "phase function");
    // Angle in degrees (0: straight on), and the weight of each colour; strictly increasing from 0 to 180,
    // weights finite and >= 0, not all 0; scaled here to the mean 1. Throws Error.
    struct Point {
        double angle_deg;
        glm::vec3 weight;
    };
    static PhaseFunction table(const std::vector<Point>& points, const std::string& source);

    bool isotropic() const { return mIsotropic; }
    glm::vec3 at(float cosine) const;  // by lookup in the table; cosines are clamped to -1..1
    // Returns the mean cosine g of each colour, computed from the table.
    glm::vec3 meanCosine() const;
    // kEntries + 1 weights; entry i stands for the angle i * pi / kEntries.
    const std::vector<glm::vec3>& entries() const { return mEntries; }

    // Returns the cosine for a new direction of a path from the table of one colour (0 red .. 2 blue), u in
    // [0, 1).
    float sampleCosine(int channel, float u) const;

private:
    explicit PhaseFunction(const std::vector<glm::dvec3>& weights);  // kEntries + 1, not scaled
    void accumulate();

    std::vector<glm::vec3> mEntries;      // weights, mean 1 over the sphere
    std::vector<glm::dvec3> mCumulative;  // share of the light up to each angle
    bool mIsotropic = true;
};

// The files of data/phase, which are part of the program.
struct PhasePreset {
    std::string_view name;
    std::string_view text;
};
std::span<const PhasePreset> phasePresets();
std::string phasePresetNames();  // "a, b, c"

// Returns "none", "hg G" or "hg G_RED G_GREEN G_BLUE", a preset's function, or a file's: lines "angle_deg red
// green blue". Throws Error: about a file's content with the file's name, else naming `asked`, the origin of
// the text.
PhaseFunction findPhaseFunction(const std::string& text, const std::string& asked = "phase function");

}  // namespace stereonav
