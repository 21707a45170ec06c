// Every function of volumes that takes a Progress tells all of it.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/volume/leap_blocks.h"
#include "engine/volume/surface_cells.h"
#include "engine/volume/value_counts.h"
#include "test_volumes.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

using test::expectWholeProgress;

// A volume longer than a block along each axis.
GreyVolume longVolume() {
    return test::greyVolume(test::slantedFrame({40, 30, 300}), [](const glm::dvec3& v) {
        return 600 - 60 * glm::distance(v, glm::dvec3(20, 15, 40));
    });
}

TEST(VolumeProgress, IsWholeOfTheSurfacesCells) {
    const GreyVolume volume = longVolume();
    MaskVolume region(volume.frame);
    for (std::size_t n = 0; n < region.frame.count() / 2; ++n) region.values[n] = 1;
    for (const bool blocks : {false, true})
        for (const MaskVolume* const within :
             {static_cast<const MaskVolume*>(nullptr), &std::as_const(region)}) {
            SurfaceSetting setting;
            setting.region = within;
            if (blocks) setting.atOnce = 0;
            expectWholeProgress(blocks ? "in blocks" : "at once", 2,
                                [&](Progress& progress) { findSurfaceCells(volume, setting, progress); });
        }
}

TEST(VolumeProgress, IsWholeOfLeapsInBlocks) {
    const GreyVolume volume = longVolume();
    expectWholeProgress("codes of leaps", 1, [&](Progress& progress) {
        SurfaceCells cells;
        cells.frame = volume.frame;
        cells.layout = BrickLayout(volume.frame.size - 1);
        codeLeapsByBlocks(volume, {}, progress, cells);
    });
}

TEST(VolumeProgress, IsWholeOfCountedValues) {
    const GreyVolume volume = longVolume();
    const MaskVolume near(volume.frame);
    for (const int border : {0, 1})
        for (const MaskVolume* const of : {static_cast<const MaskVolume*>(nullptr), &near})
            expectWholeProgress("counted values", 5,
                                [&](Progress& progress) { countValues(volume, border, of, progress); });
}

}  // namespace
}  // namespace stereonav
