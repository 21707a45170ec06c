// Places of a grid in its file's own reference system, through GDAL's OSR where the samples were brought to
// another one.
#include "terrain/raster/reference_places.h"

#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <utility>

#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

using WayBetween = std::unique_ptr<OGRCoordinateTransformation>;

class GridInReference final : public ReferencePlaces {
public:
    GridInReference(const Georeference& grid, const glm::dvec2& spacing, WayBetween to, WayBetween from)
        : mGrid(grid), mSpacing(spacing), mTo(std::move(to)), mFrom(std::move(from)) {}

    std::optional<glm::dvec2> referenceAt(const glm::dvec2& world) const override {
        return through(mTo.get(), mGrid.fromPixel(middle() + glm::dvec2(world.x, -world.y) / mSpacing));
    }
    std::optional<glm::dvec2> worldAt(const glm::dvec2& reference) const override {
        const auto own = through(mFrom.get(), reference);
        if (!own) return std::nullopt;
        const glm::dvec2 pixels = mGrid.toPixel(*own) - middle();
        return glm::dvec2(pixels.x * mSpacing.x, -pixels.y * mSpacing.y);
    }

private:
    glm::dvec2 middle() const { return 0.5 * glm::dvec2(mGrid.width, mGrid.height); }
    // Returns the place by the transform; null for two systems that are one. Returns nothing where there is
    // no such place.
    static std::optional<glm::dvec2> through(OGRCoordinateTransformation* transform, glm::dvec2 p) {
        const GdalMessages messages;  // catches those about places that a projection does not have
        if (transform && !transform->Transform(1, &p.x, &p.y)) return std::nullopt;
        if (!std::isfinite(p.x + p.y)) return std::nullopt;
        return p;
    }

    Georeference mGrid;
    glm::dvec2 mSpacing;  // metres a pixel
    WayBetween mTo, mFrom;
};

}  // namespace

std::unique_ptr<ReferencePlaces> referencePlaces(const Georeference& source, const Georeference& grid,
                                                 const glm::dvec2& spacing) {
    WayBetween to, from;
    if (source.wkt != grid.wkt && !source.wkt.empty() && !grid.wkt.empty()) {
        const GdalMessages messages;
        OGRSpatialReference file, own;
        if (file.importFromWkt(source.wkt.c_str()) != OGRERR_NONE ||
            own.importFromWkt(grid.wkt.c_str()) != OGRERR_NONE)
            return nullptr;
        for (OGRSpatialReference* system : {&file, &own})
            system->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        to.reset(OGRCreateCoordinateTransformation(&own, &file));
        from.reset(OGRCreateCoordinateTransformation(&file, &own));
        if (!to || !from) return nullptr;
    }
    return std::make_unique<GridInReference>(grid, spacing, std::move(to), std::move(from));
}

}  // namespace stereonav
