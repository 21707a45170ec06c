// Light from infinitely far away, given by direction: an equirectangular picture, row 0 at the zenith (+z),
// column 0 at azimuth -pi (azimuth 0 is +x, growing towards +y). Immutable.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace stereonav {

// A sky. Radiance is linear RGB, 0 and more.
class LightProbe {
public:
    // width * height pixels of linear radiance, row by row. Throws Error (naming `name`) when a pixel is
    // negative or not finite, or the picture is empty.
    LightProbe(int width, int height, std::vector<glm::vec3> radiance, const std::string& name);

    // Returns the radiance of the pixel that the unit direction falls into: it is piecewise constant.
    glm::vec3 radiance(const glm::vec3& direction) const;
    // radiance() and density() at once, for the cost of one.
    struct Seen {
        glm::vec3 radiance;  // linear RGB
        float density;       // per steradian
    };
    Seen seen(const glm::vec3& direction) const;

    // A chosen direction, with the radiance and density there.
    struct Sample {
        glm::vec3 direction, radiance;  // unit; linear RGB
        float density;                  // per steradian; > 0 unless the probe is black
    };
    // Chooses a direction in proportion to luminance times solid angle. u in [0, 1)^2; evenly spread u give
    // evenly spread directions.
    Sample sample(const glm::vec2& u) const;
    // Returns the density, per steradian, with which sample() gives a direction; 0 for a black probe.
    float density(const glm::vec3& direction) const;

    // Returns harmonicsCount(order) coefficients a channel, exact over the pixels. Throws Error for an order
    // out of 1..kMaxHarmonicsOrder.
    std::vector<glm::vec3> project(int order) const;

    glm::vec3 mean() const { return mMean; }  // radiance over the sphere
    bool black() const { return mBlack; }
    std::span<const glm::vec3> pixels() const { return mRadiance; }
    int width() const { return mWidth; }
    int height() const { return mHeight; }

private:
    struct Pixel {
        int column, row;
    };
    std::size_t index(const Pixel& p) const { return static_cast<std::size_t>(p.row) * mWidth + p.column; }
    Pixel pixelOf(const glm::vec3& direction) const;
    glm::vec3 directionIn(const Pixel& pixel, const glm::dvec2& fraction) const;
    double densityOf(const Pixel& pixel) const;
    void fillRow(int row);

    int mWidth, mHeight;
    std::vector<glm::vec3> mRadiance;  // linear RGB
    std::vector<double> mEdges;        // cosine of the polar angle at the upper edge of row j; mHeight + 1
    // Running sums of the probability of rows, and of columns within their row (mWidth + 1 per row). Double,
    // because the probability of a dim pixel is a small difference of two sums.
    std::vector<double> mRows, mColumns;
    glm::vec3 mMean{0.0f};
    bool mBlack = false;
};

// Reads .hdr, or any other picture (taken as sRGB), as a panorama: its middle is seen towards +y, its right
// half towards +x, like a terrain's sky. Where the width is not divisible by 4, it is turned by up to half a
// column. Throws Error.
LightProbe readLightProbe(const std::filesystem::path& file);

}  // namespace stereonav
