// A picture of the ground in a file: where it lies over an elevation model, and its pixels over any part of
// it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terrain/ground/heightfield.h"
#include "terrain/raster/georeference.h"
#include "terrain/raster/ground_picture.h"
#include "terrain/read/dem_reader.h"
#include "terrain/scene/ground_texture.h"

namespace stereonav {

// Keeps no file open: every read opens it anew, so that parts may be read from any thread.
class LaidPicture {
public:
    // Opens the picture. dem: its heights are not read. Throws Error that names the picture, among others
    // where it does not overlap.
    LaidPicture(const std::filesystem::path& file, const DemGrid& dem);

    // Returns pixels a sample, each way, of a ground, or a part of one, at any of its levels: by that at the
    // model's middle.
    glm::dvec2 density(const Heightfield& ground) const { return mDensity * ground.spacing() / mSpacing; }

    struct Pixels {
        PixelMap map;  // from the texels' columns and rows
        GroundPicture picture;
    };
    // Returns what a texture of that size over a ground needs, averaged down to its texels: from the file's
    // overviews where it has them. Returns nothing where the picture does not reach it. From any thread.
    // Throws Error where the file can not be read any more, or would not fit into memory.
    std::optional<Pixels> over(const Heightfield& ground, const GroundTextureSize& size) const;

    // Returns what was guessed of its colours, a line each.
    const std::vector<std::string>& notes() const { return mTone.notes; }
    // "image winter.jpg 457x499 over the same extent"
    std::string describe() const;
    // Throws Error that names the picture.
    [[noreturn]] void throwNoOverlap() const;

private:
    Georeference gridOf(const Heightfield& ground, const GroundTextureSize& size) const;

    std::filesystem::path mFile;
    Georeference mGrid;   // grid of the model's finest samples
    glm::dvec2 mSpacing;  // spacing of those, metres
    Georeference mPlace;  // the picture's own, or over the elevation file's extent
    bool mOwn = false;
    glm::dvec2 mDensity{1.0};  // pixels a finest sample
    PictureTone mTone;
};

}  // namespace stereonav
