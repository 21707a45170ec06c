// The place of an elevation raster, and the conversion of its samples to a grid in metres; see the header.
#include "terrain/read/gdal/dem_placement.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "terrain/read/gdal/coded_tile.h"
#include "terrain/read/gdal/reference_system.h"

namespace stereonav {
namespace {

constexpr double kScaleTolerance = 0.01;  // a projection stretched by more is not metres on the ground

// Coordinates without a reference system that can hardly be anything but degrees: fine steps inside
// the globe's range, not starting at (0, 0) as measured surfaces do.
bool looksLikeDegrees(const Georeference& raster) {
    const glm::dvec2 a = raster.fromPixel({0, 0}), b = raster.fromPixel({raster.width, raster.height});
    const auto within = [](const glm::dvec2& p) { return std::abs(p.x) <= 360 && std::abs(p.y) <= 90.01; };
    const bool atZero = std::abs(std::min(a.x, b.x)) < 1e-9 && std::abs(std::min(a.y, b.y)) < 1e-9;
    return within(a) && within(b) && !atZero && raster.axisAligned() &&
           std::abs(raster.transform[1]) <= 0.02 && std::abs(raster.transform[5]) <= 0.02;
}

// The system's name; files that leave it out get one from the datum and the projection.
std::string systemName(const std::string& wkt) {
    OGRSpatialReference system;
    if (wkt.empty() || system.importFromWkt(wkt.c_str()) != OGRERR_NONE) return "";
    const char* name = system.GetName();
    if (name && std::string_view(name) != "unnamed" && std::string_view(name) != "unknown") return name;
    const char *datum = system.GetAttrValue("GEOGCS"), *projection = system.GetAttrValue("PROJECTION");
    int north = 0;
    const int zone = system.GetUTMZone(&north);
    std::string made = datum ? datum : "unnamed datum";
    if (zone != 0)
        made += fmt::format(" / UTM zone {}{}", zone, north ? 'N' : 'S');
    else if (projection)
        made += fmt::format(" / {}", projection);
    return made;
}

// Returns what its heights are counted from: the vertical part of its reference system, or the ellipsoid of
// one with three axes.
std::string verticalDatumOf(GDALDataset& dataset) {
    const OGRSpatialReference* system = dataset.GetSpatialRef();
    if (!system) system = dataset.GetGCPSpatialRef();
    if (!system) return "";
    const auto text = [](const char* word) { return std::string(word ? word : ""); };
    if (!system->IsCompound())
        return system->GetAxesCount() == 3 ? "the ellipsoid of " + text(system->GetName()) : "";
    const std::string name = text(system->GetAttrValue("VERT_CS")),
                      datum = text(system->GetAttrValue("VERT_DATUM"));
    if (name.empty() || datum.empty() || name == datum) return name.empty() ? datum : name;
    return name + ", " + datum;
}

void placeSource(GDALDataset& dataset, const OpenedDem& opened, const std::filesystem::path& file,
                 DemGrid& dem) {
    dem.source = georeferenceOf(dataset, file, dem.georeferenced);
    dem.driver = dataset.GetDriver()->GetMetadataItem(GDAL_DMD_LONGNAME);
    if (std::string_view(dataset.GetDriverName()) == "GTiff") dem.driver = "GeoTIFF";
    if (const std::size_t files = opened.files.size(); files > 0)
        dem.driver = fmt::format("{} file{} of a folder", files, files == 1 ? "" : "s");
    dem.notes = opened.notes;
    dem.crs = systemName(dem.source.wkt);
    dem.verticalDatum = verticalDatumOf(dataset);
    dem.bodyRadius = bodyRadiusOf(dem.source);
    if (dem.source.wkt.empty() && dem.georeferenced && looksLikeDegrees(dem.source)) {
        OGRSpatialReference degrees;
        degrees.importFromEPSG(4326);
        dem.source.wkt = wktOf(degrees);
        dem.crs = "WGS 84 (assumed: the file names none, its coordinates look like degrees)";
    }
    const CodedTile tile = codedTileOf(dataset, file);
    if (tile.code == TileCode::None) return;
    dem.driver = nameOf(tile.code);
    if (!tile.note.empty()) dem.notes.push_back(file.string() + ": " + tile.note);
    if (dem.georeferenced) return;
    constexpr double kZoom14At36North_m = 40075016.68557849 / (256.0 * 16384.0) * 0.80901699437494742;
    const auto place = webTileOf(file);
    const double step = place ? place->spacing(dem.source.width) : kZoom14At36North_m;
    dem.source.transform = {0, step, 0, 0, 0, -step};
    dem.projection = fmt::format("tile of {:.4g} m a sample, {}", step,
                                 place ? "from its path zoom/x/y" : "assumed: zoom 14 at 36 degrees north");
    if (!place)
        dem.notes.push_back(
            fmt::format("{}: taken for a tile of {:.4g} m a sample, of zoom 14 at 36 degrees "
                        "north: its path does not end in zoom/x/y",
                        file.string(), step));
}

// The plane that ground lies in as it is.
struct OwnPlane {
    double metres = 0;    // on the ground, in a unit; 0: it has none, and is brought to another plane
    bool stays = false;   // also where the raster has to be turned level
    std::string stretch;  // stretch of the plane over a pole, in words
};

// Over a pole no transverse Mercator is north up: the raster's own projection stays, in metres on the ground
// at its middle.
OwnPlane polarPlane(const Georeference& source, double unit, const std::filesystem::path& file) {
    constexpr double kMostStretch = 1.2;  // a map of an arctic continent
    constexpr int kPlaces = 9;
    const auto mapScale = [&](const glm::dvec2& pixel) {
        const glm::dvec2 ground = groundScale(source, pixel);
        return 1 / std::sqrt(ground.x * ground.y);
    };
    const glm::dvec2 size(source.width, source.height);
    const double middle = mapScale(0.5 * size);
    double low = middle, high = middle;
    for (int k = 0; k < kPlaces * kPlaces; ++k) {
        const double scale = mapScale(size * glm::dvec2(k % kPlaces, k / kPlaces) / (kPlaces - 1.0));
        low = std::min(low, scale), high = std::max(high, scale);
    }
    if (!(high <= kMostStretch * low))
        throw Error(file.string(), "extent",
                    fmt::format("expected a map over the pole whose scales differ by at most {:g} times, "
                                "got {:.4g} to {:.4g}",
                                kMostStretch, low, high),
                    "cut out a part, for example with gdal_translate -projwin");
    const bool onGround = std::abs(middle - 1) <= kScaleTolerance;
    return {onGround ? unit : unit / middle, true,
            fmt::format(", over the pole: map scale {:.4g} in its middle, {:.4g} to {:.4g} all over", middle,
                        low, high)};
}

OwnPlane ownPlane(const Georeference& source, const std::filesystem::path& file) {
    const double unit = metresPerUnit(source);
    if (unit == 0) return {};
    if (holdsPole(source)) return polarPlane(source, unit, file);
    const glm::dvec2 scale = groundScale(source, 0.5 * glm::dvec2(source.width, source.height));
    const bool onGround = std::max(std::abs(scale.x - 1), std::abs(scale.y - 1)) <= kScaleTolerance;
    return {onGround ? unit : 0.0, !onEarth(source), ""};
}

std::string projectionAsItIs(const DemGrid& dem, double metres) {
    if (!dem.georeferenced) return "none: 1 m a sample";
    return metres == 1.0 ? "as it is" : fmt::format("as it is, {:.9g} m a unit", metres);
}

std::string projectionResampled(const DemGrid& dem, bool ownSystem) {
    return fmt::format("{}, resampled from {}x{}",
                       dem.grid.wkt.empty() ? "turned level"
                       : ownSystem          ? "turned level in its own projection"
                                            : "local transverse Mercator",
                       dem.source.width, dem.source.height);
}

// North up and east right, of an axis-aligned raster.
Georeference turnedOver(const Georeference& source) {
    Georeference grid = source;
    auto& t = grid.transform;
    if (t[1] < 0) t[0] += t[1] * grid.width, t[1] = -t[1];
    if (t[5] > 0) t[3] += t[5] * grid.height, t[5] = -t[5];
    t[2] = t[4] = 0;
    return grid;
}

// Refuses a file that is placed by what is not read here: it would be taken for one that has no place.
void checkPlacement(GDALDataset& dataset, const std::filesystem::path& file, bool georeferenced) {
    if (georeferenced) return;
    for (const auto& [domain, advice] : {std::pair{"RPC", "rectify it, for example with gdalwarp -rpc"},
                                         {"GEOLOCATION", "rectify it, for example with gdalwarp -geoloc"}})
        if (dataset.GetMetadata(domain))
            throw Error(file.string(), "georeference",
                        fmt::format("expected a transform or control points, found {} alone",
                                    std::string_view(domain) == "RPC" ? "rational polynomials (RPC)"
                                                                      : "arrays of places"),
                        advice);
}

void checkGrid(const std::filesystem::path& file, const DemGrid& dem) {
    if (dem.source.width < 2 || dem.source.height < 2)
        throw Error(
            file.string(), "size",
            fmt::format("expected at least 2x2 samples, got {}x{}", dem.source.width, dem.source.height),
            "a surface needs two samples each way");
    for (const double number : dem.source.transform)
        if (!std::isfinite(number))
            throw Error(file.string(), "georeference", "expected finite numbers, got others",
                        "check the file's pixel size and corner");
    const auto& t = dem.source.transform;
    if (t[1] * t[5] - t[2] * t[4] == 0)
        throw Error(file.string(), "georeference",
                    fmt::format("expected pixel sizes that are not 0, got {:g} x {:g}", t[1], t[5]),
                    "check the file's pixel size");
}

}  // namespace

void describeSource(GDALDataset& dataset, const OpenedDem& opened, const std::filesystem::path& file,
                    DemGrid& dem) {
    placeSource(dataset, opened, file, dem);
    checkPlacement(dataset, file, dem.georeferenced);
    checkGrid(file, dem);
}

DemPlacement placementOf(const Georeference& source, const std::filesystem::path& file,
                         const RasterLimits& limits) {
    const OwnPlane plane = ownPlane(source, file);
    DemPlacement placement;
    placement.ownUnit_m = plane.metres, placement.staysInPlane = plane.stays;
    placement.stretch = plane.stretch;
    placement.asTheyAre = plane.metres > 0 && source.points.empty() && source.axisAligned();
    if (placement.asTheyAre) {
        placement.grid = turnedOver(source);
        placement.westward = source.transform[1]<0, placement.southFirst = source.transform[5]> 0;
        return placement;
    }
    placement.grid = metricGrid(source, plane.stays, file);
    checkRasterSize(file, placement.grid.width, placement.grid.height, limits);
    return placement;
}

void placeOnGrid(const DemPlacement& placement, DemGrid& dem) {
    dem.grid = placement.grid;
    dem.width = dem.grid.width, dem.height = dem.grid.height;
    const bool own = placement.asTheyAre || placement.staysInPlane;
    const double unit = own ? placement.ownUnit_m : 1.0;
    if (dem.projection.empty())
        dem.projection = (placement.asTheyAre ? projectionAsItIs(dem, unit)
                                              : projectionResampled(dem, placement.staysInPlane)) +
                         placement.stretch;
    if (dem.georeferenced && own) dem.sourceUnit = unit;
    dem.spacing = glm::dvec2(dem.grid.transform[1], -dem.grid.transform[5]) * unit;
    dem.sourceOffset = dem.grid.fromPixel(0.5 * glm::dvec2(dem.width, dem.height));
}

}  // namespace stereonav
