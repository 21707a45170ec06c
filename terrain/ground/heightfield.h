// A heightfield: the continuous bilinear surface over a regular grid of samples. Everything that
// casts, shades or bakes terrain reads this one structure; it does not change after loading.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace stereonav {

// Spaces. World: metres, x east, y north, z up; its origin is the middle of the grid (for a part, of the
// whole ground's grid) at height 0 of the source. Grid: gx = (x - originWorld.x) / spacing.x, so that sample
// (i, j) is at (i, j); i counts east, j north. Cell (i, j) has the corner samples (i, j) to (i + 1, j + 1).
class Heightfield {
public:
    Heightfield() = default;
    // heights: metres above z = 0, width * height values, row 0 southernmost; NaN marks a hole in the ground
    // (every cell touching it is open). spacing: metres, > 0. At least 2 x 2 samples, and one finite cell.
    // Throws Error otherwise, which names `source`.
    Heightfield(int width, int height, glm::dvec2 spacing, std::vector<float> heights,
                const std::string& source);
    // Makes a part of a larger ground. The place of its sample (0, 0) is given in the world, metres.
    Heightfield(int width, int height, glm::dvec2 spacing, std::vector<float> heights,
                const std::string& source, const glm::dvec2& originWorld)
        : Heightfield(width, height, spacing, std::move(heights), source) {
        mOrigin = originWorld;
    }

    // Returns whether some cell has four known samples: without one there is no ground.
    static bool anyCell(int width, int height, const float* heights);

    int width() const { return mWidth; }                // samples, >= 2
    int height() const { return mHeight; }              // samples, >= 2
    glm::dvec2 spacing() const { return mSpacing; }     // metres between samples
    glm::dvec2 originWorld() const { return mOrigin; }  // place of sample (0, 0), metres
    float minHeight() const { return mMin; }            // metres, of all cells without a hole
    float maxHeight() const { return mMax; }            // metres
    // Returns a Lipschitz constant of the surface: |h(p) - h(q)| <= maxSlope() * |p - q|, in metres per
    // metre. Infinite where there are holes.
    double maxSlope() const { return mMaxSlope; }
    bool hasHoles() const { return mHasHoles; }

    // Metres, NaN where missing: one sample, or all of them, row by row.
    float sample(int i, int j) const { return mHeights[static_cast<std::size_t>(j) * mWidth + i]; }
    const float* data() const { return mHeights.data(); }

    glm::dvec2 gridFromWorld(const glm::dvec2& world) const { return (world - mOrigin) / mSpacing; }
    glm::dvec2 worldFromGrid(const glm::dvec2& grid) const { return mOrigin + grid * mSpacing; }
    // Returns whether a place lies over the grid, its border included.
    bool contains(const glm::dvec2& world) const;

    // Returns the height in metres at a world position; positions outside are clamped to the border. NaN in a
    // hole.
    double heightAt(const glm::dvec2& world) const;
    // Returns the unit normal, continuous across cells: from gradients at the samples (central differences,
    // one-sided at borders and holes), interpolated bilinearly. Clamped outside.
    glm::dvec3 normalAt(const glm::dvec2& world) const;
    // Returns the gradient (dh/dx, dh/dy) at a sample, metres a metre.
    glm::dvec2 gradientAtSample(int i, int j) const;

private:
    int mWidth = 0, mHeight = 0;
    glm::dvec2 mSpacing{1.0}, mOrigin{0.0};  // metres; world
    float mMin = 0, mMax = 0;                // metres
    double mMaxSlope = 0;                    // metres a metre
    bool mHasHoles = false;
    std::vector<float> mHeights;
};

}  // namespace stereonav
