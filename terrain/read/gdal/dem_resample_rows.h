// Resamples elevation samples to another grid in runs of rows: resampleDem() for ground larger than memory,
// without the restored summits and pits.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "terrain/raster/georeference.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/reference_system.h"

namespace stereonav {

// For one thread.
class ResampledRows {
public:
    // Reads the samples of a window of the source, in its row order.
    using ReadWindow = std::function<void(const SampleWindow& window, float* samples)>;
    // Throws Error as resampleDem() does.
    ResampledRows(const Georeference& source, const Georeference& target, const std::filesystem::path& file,
                  ReadWindow read);

    // Resamples rows of the target from `first` on, counted from its first row. Throws the exceptions of
    // reading, Cancelled.
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
