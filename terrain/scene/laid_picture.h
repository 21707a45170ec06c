// A picture of the ground in a file: its place over an elevation model, and its pixels over any part of the
// model.
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

// Keeps no file open: every read opens it again, so that any thread may read parts.
class LaidPicture {
public:
    // Opens the picture. dem: only its place is used, not its heights. Throws Error that names the picture,
    // for example where it does not overlap the model.
    LaidPicture(const std::filesystem::path& file, const DemGrid& dem);

    // Returns the number of pixels per sample in each direction, for a ground or a part of one at any level,
    // as measured in the middle of the model.
    glm::dvec2 density(const Heightfield& ground) const { return mDensity * ground.spacing() / mSpacing; }

    struct Pixels {
        PixelMap map;  // from the texels' columns and rows
        GroundPicture picture;
    };
    // Returns the pixels for a texture of that size over a ground, averaged down to its texels: from the
    // file's overviews where it has them. Empty where the picture does not reach the ground. From any thread.
    // Throws Error where the file can not be read any more, or would not fit into memory.
    std::optional<Pixels> over(const Heightfield& ground, const GroundTextureSize& size) const;

    // Returns notes about guesses of its colours, a line each.
    const std::vector<std::string>& notes() const { return mTone.notes; }
    // Returns a description such as "image winter.jpg 457x499 over the same extent".
    std::string describe() const;
    // Throws Error that names the picture.
    [[noreturn]] void throwNoOverlap() const;

private:
    Georeference gridOf(const Heightfield& ground, const GroundTextureSize& size) const;

    std::filesystem::path mFile;
    Georeference mGrid;   // grid of the model's finest samples
    glm::dvec2 mSpacing;  // metres between those samples
    Georeference mPlace;  // georeference of the picture; its own, or the extent of the elevation file
    bool mOwn = false;
    glm::dvec2 mDensity{1.0};  // pixels per finest sample
    PictureTone mTone;
};

}  // namespace stereonav
