// Places on the Earth through GDAL's OSR, exact: each is brought from the grid's reference system to WGS 84.
#include "terrain/raster/earth_places.h"

#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "engine/math/earth_bend.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/reference_system.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct DestroyTransform {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
};
using Transform = std::unique_ptr<OGRCoordinateTransformation, DestroyTransform>;

// Coordinates in the order x, y and longitude, latitude, whatever the systems' authorities say.
Transform between(OGRSpatialReference from, OGRSpatialReference to) {
    from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return Transform(OGRCreateCoordinateTransformation(&from, &to));
}

bool isOnEarth(const glm::dvec2& degrees) {
    return std::abs(degrees.x) <= 720 && std::abs(degrees.y) <= 90;
}

class GridOnEarth final : public EarthPlaces {
public:
    GridOnEarth(const Georeference& grid, const glm::dvec2& spacing, Transform toEarth, Transform fromEarth)
        : mGrid(grid), mSpacing(spacing), mToEarth(std::move(toEarth)), mFromEarth(std::move(fromEarth)) {
        const auto middle = degreesAt(0.5 * glm::dvec2(grid.width, grid.height));
        if (middle) mNear = middle->x;
    }

    std::optional<EarthPlace> placeAt(const glm::dvec2& world) const override {
        const std::lock_guard lock(mMutex);
        const GdalMessages messages;  // catches those about places that the projection does not have
        const auto degrees = degreesAt(middle() + glm::dvec2(world.x, -world.y) / mSpacing);
        if (!degrees) return std::nullopt;
        return EarthPlace{degrees->y * kDegree, std::remainder(degrees->x, 360) * kDegree};
    }

    std::optional<glm::dvec2> worldAt(const EarthPlace& place) const override {
        glm::dvec2 p(place.longitude / kDegree, place.latitude / kDegree);
        if (!isOnEarth(p)) return std::nullopt;
        // On the grid's own side of the date line.
        p.x += 360 * std::round((mNear - p.x) / 360);
        const std::lock_guard lock(mMutex);
        const GdalMessages messages;  // catches those about places that the projection does not have
        if (!mFromEarth->Transform(1, &p.x, &p.y)) return std::nullopt;
        const glm::dvec2 pixels = mGrid.toPixel(p) - middle(),
                         world(pixels.x * mSpacing.x, -pixels.y * mSpacing.y);
        if (!std::isfinite(world.x + world.y)) return std::nullopt;
        return world;
    }

private:
    glm::dvec2 middle() const { return 0.5 * glm::dvec2(mGrid.width, mGrid.height); }

    std::optional<glm::dvec2> degreesAt(const glm::dvec2& pixel) const {
        glm::dvec2 p = mGrid.fromPixel(pixel);
        if (!std::isfinite(p.x + p.y) || !mToEarth->Transform(1, &p.x, &p.y)) return std::nullopt;
        if (!std::isfinite(p.x + p.y) || !isOnEarth(p)) return std::nullopt;
        return p;
    }

    Georeference mGrid;
    glm::dvec2 mSpacing;  // metres a pixel
    Transform mToEarth, mFromEarth;
    double mNear = 0;  // degrees: the longitude of its middle
    mutable std::mutex mMutex;
};

}  // namespace

std::unique_ptr<EarthPlaces> earthPlaces(const Georeference& grid, const glm::dvec2& spacing) {
    if (grid.wkt.empty() || !Body{bodyRadiusOf(grid)}.isEarth() || !onEarth(grid)) return nullptr;
    const GdalMessages messages;  // catches those about other bodies' systems, which have no way to WGS 84
    OGRSpatialReference own, earth;
    if (own.importFromWkt(grid.wkt.c_str()) != OGRERR_NONE ||
        earth.SetWellKnownGeogCS("WGS84") != OGRERR_NONE)
        return nullptr;
    Transform to = between(own, earth), from = between(earth, own);
    if (!to || !from) return nullptr;
    auto places = std::make_unique<GridOnEarth>(grid, spacing, std::move(to), std::move(from));
    if (!places->placeAt(glm::dvec2(0.0))) return nullptr;
    return places;
}

}  // namespace stereonav
