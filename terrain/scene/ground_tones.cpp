#include "terrain/scene/ground_tones.h"

#include "terrain/scene/map_tones.h"
#include "terrain/scene/natural_tones.h"

namespace stereonav {
namespace {

static_assert(GroundShape::kBytesPerSample <= kBytesOfTones);
static_assert(GroundTint::kBytesPerSample <= kBytesOfTones);

// The tints of ground_tint.h.
class TintTones final : public GroundTones {
public:
    TintTones(const Heightfield& part, const TintPlace& place, const Heightfield& whole)
        : mTint(part, place, whole) {}
    GroundTone at(const glm::dvec2& grid, double height) const override {
        const GroundTint::Site site = mTint.siteAt(grid);
        return {mTint.at(grid, height, site), site.normal()};
    }

private:
    GroundTint mTint;
};

}  // namespace

std::unique_ptr<GroundTones> groundTones(const Heightfield& part, const TintPlace& place,
                                         const Heightfield& whole) {
    switch (place.palette) {
        case GroundPalette::Natural:
            return std::make_unique<NaturalTones>(part, place, whole);
        case GroundPalette::Hypsometric:
        case GroundPalette::Swiss:
        case GroundPalette::Grey:
            return std::make_unique<MapTones>(part, place, whole);
        case GroundPalette::Tint:
            break;
    }
    return std::make_unique<TintTones>(part, place, whole);
}

std::string describePalette(const TintPlace& place) {
    switch (place.palette) {
        case GroundPalette::Natural:
            return place.latitudes.empty()
                       ? "natural colours by height, slope and wetness, of no known latitude"
                       : "natural colours by latitude, height, slope, aspect and wetness";
        case GroundPalette::Hypsometric:
            return "hypsometric tints of the ground's own heights";
        case GroundPalette::Swiss:
            return "relief colours after Imhof, lit from the north-west";
        case GroundPalette::Grey:
            return "grey";
        case GroundPalette::Tint:
            break;
    }
    return "tint by height and slope";
}

}  // namespace stereonav
