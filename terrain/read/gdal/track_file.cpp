// Tracks and drawn lines through OGR: GPX and GeoJSON.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/base/error.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/reference_files.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr const char* kTrackFormats = "a GPX or GeoJSON file";
constexpr const char* const kTrackDrivers[] = {"GPX", "GeoJSON", nullptr};

void registerTrackDrivers() {
    static std::once_flag once;
    std::call_once(once, [] {
        RegisterOGRGPX();
        RegisterOGRGeoJSON();
    });
}

void addLine(const OGRSimpleCurve& curve, const std::string& name, bool closed, int feature,
             std::vector<TrackLine>& lines) {
    TrackLine line{name, closed, {}, feature};
    for (int n = 0; n < curve.getNumPoints(); ++n) line.degrees.emplace_back(curve.getX(n), curve.getY(n));
    if (closed && line.degrees.size() > 1 && line.degrees.front() == line.degrees.back())
        line.degrees.pop_back();
    lines.push_back(std::move(line));
}

// Lines, outer borders and, where asked for, places, whatever they lie in. A collection of collections that
// goes on and on is cut off.
void addParts(const OGRGeometry& geometry, const std::string& name, int feature, int depth, bool places,
              TrackFile& read) {
    constexpr int kDeepest = 8;
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbLineString:
            addLine(*geometry.toLineString(), name, false, feature, read.lines);
            break;
        case wkbPolygon:
            if (const OGRLinearRing* ring = geometry.toPolygon()->getExteriorRing())
                addLine(*ring, name, true, feature, read.lines);
            break;
        case wkbPoint:
            if (const OGRPoint* point = geometry.toPoint(); places && !point->IsEmpty())
                read.places.push_back({name, {point->getX(), point->getY()}});
            break;
        case wkbMultiPoint:
        case wkbMultiLineString:
        case wkbMultiPolygon:
        case wkbGeometryCollection:
            if (depth < kDeepest)
                for (const OGRGeometry* part : geometry.toGeometryCollection())
                    addParts(*part, name, feature, depth + 1, places, read);
            break;
        default:
            break;
    }
}

// Segments without two places that differ, as receivers write them where they lose the sky: they are no
// reason to refuse the others.
void leaveOutPointless(TrackFile& read) {
    const auto leadsNowhere = [](const TrackLine& line) {
        return std::all_of(line.degrees.begin(), line.degrees.end(),
                           [&](const glm::dvec2& place) { return place == line.degrees.front(); });
    };
    const auto lines =
        static_cast<std::size_t>(std::count_if(read.lines.begin(), read.lines.end(), leadsNowhere));
    if (lines < read.lines.size() || !read.places.empty()) std::erase_if(read.lines, leadsNowhere);
}

// The layer's places to longitude and latitude; false where there is no way.
bool toDegrees(OGRGeometry& geometry) {
    const OGRSpatialReference* own = geometry.getSpatialReference();
    OGRSpatialReference earth;
    if (!own || earth.SetWellKnownGeogCS("WGS84") != OGRERR_NONE) return own == nullptr;
    earth.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return own->IsSame(&earth) || geometry.transformTo(&earth) == OGRERR_NONE;
}

}  // namespace

TrackFile readTrackFile(const std::filesystem::path& file) {
    GdalMessages messages;
    registerTrackDrivers();
    checkFileForGdal(file, "name a track or a drawn line");
    checkJsonReferences(file);
    GdalDataset dataset(GDALDataset::Open(
        nameForGdal(file).c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kTrackDrivers));
    if (!dataset) messages.throwIfRefused(file);
    if (!dataset)
        throw Error(file.string(), "", std::string("expected ") + kTrackFormats + ", found something else",
                    "tracks end in .gpx, drawn lines in .geojson or .json");
    TrackFile read;
    int features = 0;
    for (OGRLayer* layer : dataset->GetLayers()) {
        // GPX has each track once as a line and once as its points.
        const std::string called = layer->GetName();
        const bool places = called != "track_points" && called != "route_points";
        for (const auto& feature : *layer) {
            const OGRGeometry* geometry = feature->GetGeometryRef();
            if (!geometry) continue;
            const int field = feature->GetFieldIndex("name");
            const std::string name = field >= 0 ? feature->GetFieldAsString(field) : "";
            const std::unique_ptr<OGRGeometry> own(geometry->clone());
            if (!toDegrees(*own))
                throw Error(file.string(), layer->GetName(), "uses a reference system without longitudes",
                            "write it in WGS 84");
            addParts(*own, name, features++, 0, places, read);
        }
    }
    messages.throwIfRefused(file);
    if (messages.hasError())
        throw Error(file.string(), "", "is damaged" + messages.reason(file), "write it again");
    if (read.lines.empty() && read.places.empty())
        throw Error(file.string(), "", "expected tracks, lines, areas or places, found none",
                    "tracks end in .gpx, drawn lines in .geojson or .json");
    leaveOutPointless(read);
    return read;
}

}  // namespace stereonav
