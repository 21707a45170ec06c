// Elevation samples on another grid, a run of its rows at a time: resampleDem() for ground larger than
// memory, but for the summits and pits that it puts back.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "terrain/raster/georeference.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/reference_system.h"

namespace stereonav {

// To one thread.
class ResampledRows {
public:
    // Samples of a window of the source, in its row order.
    using ReadWindow = std::function<void(const SampleWindow& window, float* samples)>;
    // Throws Error as resampleDem() does.
    ResampledRows(const Georeference& source, const Georeference& target, const std::filesystem::path& file,
                  ReadWindow read);

    // Rows of the target from first on, counted from its own first. Throws what reading throws, Cancelled.
    void read(int first, int rows, float* heights);

private:
    struct Box {
        glm::dvec2 low, high;
        bool any() const { return low.x <= high.x; }
    };
    void resample(const PixelMap& map, int mapFirst, const SampleWindow& block, float* heights);
    Box boxOf(const PixelMap& map, int mapFirst, const SampleWindow& block) const;

    Georeference mSource, mTarget;
    PixelMapRows mMap;
    ReadWindow mRead;
    std::vector<float> mSamples;  // samples of a window of the source
};

}  // namespace stereonav
