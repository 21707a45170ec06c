// Ground control points through GDAL's polynomial transformer; see the header.
#include "terrain/read/gdal/control_points.h"

#include <fmt/format.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {
namespace {

constexpr std::size_t kFewestPoints = 3;
constexpr std::size_t kFewestOfSecondOrder = 6;
constexpr double kStraight = 0.05;   // samples: points off a straight grid by less are on it
constexpr double kNarrowest = 1e-3;  // width over length of the points' spread: less is a line
constexpr const char* kPointsPlace = "ground control points";

std::vector<GDAL_GCP> gdalPoints(const std::vector<ControlPoint>& points) {
    static char none[] = "";
    std::vector<GDAL_GCP> list;
    list.reserve(points.size());
    for (const ControlPoint& p : points)
        list.push_back({none, none, p.pixel.x, p.pixel.y, p.reference.x, p.reference.y, 0.0});
    return list;
}

void* polynomial(const std::vector<ControlPoint>& points) {
    const std::vector<GDAL_GCP> list = gdalPoints(points);
    return GDALCreateGCPTransformer(static_cast<int>(list.size()), list.data(), 2, FALSE);
}

std::vector<ControlPoint> pointsOf(GDALDataset& dataset, bool degrees, double turn) {
    std::vector<ControlPoint> points;
    const GDAL_GCP* list = dataset.GetGCPs();
    points.reserve(static_cast<std::size_t>(dataset.GetGCPCount()));
    for (int k = 0; k < dataset.GetGCPCount(); ++k)
        points.push_back({{list[k].dfGCPPixel, list[k].dfGCPLine}, {list[k].dfGCPX, list[k].dfGCPY}});
    // Over the date line: all within half a turn of the first.
    if (degrees)
        for (ControlPoint& p : points)
            p.reference.x += turn * std::round((points[0].reference.x - p.reference.x) / turn);
    return points;
}

// Returns width over length of the ellipse of the points' spread; 0 where all lie at one place.
double spread(const std::vector<ControlPoint>& points, glm::dvec2 ControlPoint::*place) {
    glm::dvec2 mean(0.0);
    for (const ControlPoint& p : points) mean += (p.*place) / double(points.size());
    double xx = 0, xy = 0, yy = 0;
    for (const ControlPoint& p : points) {
        const glm::dvec2 d = p.*place - mean;
        xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    }
    const double half = 0.5 * (xx + yy), root = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    return half + root > 0 ? std::sqrt(std::max(0.0, half - root) / (half + root)) : 0.0;
}

void checkPoints(const std::vector<ControlPoint>& points, const std::filesystem::path& file) {
    constexpr const char* kFitAgain =
        "georeference the file again, for example with gdal_translate -gcp or a GIS";
    if (points.size() < kFewestPoints)
        throw Error(file.string(), kPointsPlace,
                    fmt::format("expected at least {}, found {}", kFewestPoints, points.size()), kFitAgain);
    for (const ControlPoint& p : points)
        if (!std::isfinite(p.pixel.x + p.pixel.y + p.reference.x + p.reference.y))
            throw Error(file.string(), kPointsPlace, "expected finite numbers, found others", kFitAgain);
    if (spread(points, &ControlPoint::pixel) < kNarrowest ||
        spread(points, &ControlPoint::reference) < kNarrowest)
        throw Error(file.string(), kPointsPlace,
                    fmt::format("expected places all over the raster, found {} on one line", points.size()),
                    kFitAgain);
}

// How far the points are off, in samples.
struct Misfit {
    double rms = 0, most = 0;
};

Misfit misfitOf(const Georeference& place, const std::vector<ControlPoint>& points) {
    const PixelPlacement placement(place);
    Misfit misfit;
    for (const ControlPoint& p : points) {
        const double off = glm::length(placement.toPixel(p.reference) - p.pixel);
        misfit.rms += off * off / double(points.size());
        misfit.most = std::max(misfit.most, off);
    }
    misfit.rms = std::sqrt(misfit.rms);
    return misfit;
}

// Returns whether both ways of the placement agree all over the raster, to a sample or a fiftieth of its
// side.
bool leadsBack(const Georeference& place) {
    const PixelPlacement placement(place);
    const glm::dvec2 size(place.width, place.height);
    const double most = 1 + 0.02 * std::max(size.x, size.y);
    constexpr int kPlaces = 9;
    for (int b = 0; b < kPlaces; ++b)
        for (int a = 0; a < kPlaces; ++a) {
            const glm::dvec2 pixel = size * glm::dvec2(a, b) / (kPlaces - 1.0);
            if (!(glm::length(placement.toPixel(placement.fromPixel(pixel)) - pixel) <= most)) return false;
        }
    return true;
}

}  // namespace

void placeByControlPoints(GDALDataset& dataset, const std::filesystem::path& file, Georeference& place) {
    const OGRSpatialReference* system = dataset.GetGCPSpatialRef();
    if (!system || system->IsEmpty())
        throw Error(file.string(), kPointsPlace,
                    fmt::format("found {} without a reference system: their unit is not known",
                                dataset.GetGCPCount()),
                    "set it, for example with gdal_translate -a_srs EPSG:32633");
    place.wkt = planWkt(*system);
    const bool degrees = system->IsGeographic();
    const double turn = degrees ? 2 * std::numbers::pi / system->GetAngularUnits() : 0.0;
    const std::vector<ControlPoint> points = pointsOf(dataset, degrees, turn);
    checkPoints(points, file);
    const std::vector<GDAL_GCP> list = gdalPoints(points);
    if (!GDALGCPsToGeoTransform(static_cast<int>(list.size()), list.data(), place.transform.data(), TRUE))
        throw Error(file.string(), kPointsPlace, "no transform can be found from them",
                    "georeference the file again, for example with gdal_translate -gcp or a GIS");
    if (misfitOf(place, points).most > kStraight && points.size() >= kFewestOfSecondOrder) {
        if (PixelPlacement::Transformer(polynomial(points))) place.points = points;
        if (!leadsBack(place)) place.points.clear();
    }
    const Misfit misfit = misfitOf(place, points);
    const char* fit = place.points.empty() ? "a transform" : "a polynomial of the second order";
    place.placedBy =
        fmt::format("{} ground control points, by {}, off by {:.2g} samples (rms), {:.2g} at most",
                    points.size(), fit, misfit.rms, misfit.most);
}

PixelPlacement::PixelPlacement(const Georeference& raster) : mRaster(raster) {
    if (raster.points.empty()) return;
    mTransformer.reset(polynomial(raster.points));
    if (!mTransformer)
        throw Error("", kPointsPlace, "no polynomial can be found from them", "georeference the file again");
}

void PixelPlacement::Destroy::operator()(void* transformer) const {
    GDALDestroyGCPTransformer(transformer);
}

glm::dvec2 PixelPlacement::through(const glm::dvec2& place, bool back) const {
    double x = place.x, y = place.y, z = 0;
    int known = 0;
    if (!GDALGCPTransform(mTransformer.get(), back, 1, &x, &y, &z, &known) || !known)
        return glm::dvec2(std::numeric_limits<double>::infinity());
    return {x, y};
}

glm::dvec2 PixelPlacement::fromPixel(const glm::dvec2& pixel) const {
    return mTransformer ? through(pixel, false) : mRaster.fromPixel(pixel);
}

glm::dvec2 PixelPlacement::toPixel(const glm::dvec2& reference) const {
    return mTransformer ? through(reference, true) : mRaster.toPixel(reference);
}

}  // namespace stereonav
