// Reference systems through GDAL's OSR. Geographic grids go to a transverse Mercator projection about
// their own middle: there its scale is 1, and at 100 km from it off by 1.2e-4.
#include "terrain/read/gdal/reference_system.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>

#include "engine/base/error.h"
#include "terrain/read/gdal/control_points.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWidestDegrees = 20.0;  // beyond it a flat world is no picture of the Earth
constexpr int kEdgePoints = 33;          // points along an edge to find its extent in another system

OGRSpatialReference referenceSystem(const std::string& wkt) {
    OGRSpatialReference system;
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (!wkt.empty()) system.importFromWkt(wkt.c_str());
    return system;
}

// Transforms from one reference system to another; the identity when either is unknown or both are the same.
class ReferenceTransform {
public:
    ReferenceTransform(const std::string& fromWkt, const std::string& toWkt,
                       const std::filesystem::path& file) {
        if (fromWkt.empty() || toWkt.empty() || fromWkt == toWkt) return;
        const OGRSpatialReference from = referenceSystem(fromWkt), to = referenceSystem(toWkt);
        mTransform.reset(OGRCreateCoordinateTransformation(&from, &to));
        if (!mTransform)
            throw Error(file.string(), "reference system",
                        "no transformation from it to a projection in metres is known",
                        "reproject the file, for example with gdalwarp -t_srs EPSG:32633");
        mTurn = fullTurnOf(to);
    }

    // near: of results that repeat around the body, the one within half a turn of near.x is taken.
    glm::dvec2 operator()(glm::dvec2 p, const glm::dvec2& near) const {
        if (!mTransform) return p;
        if (!mTransform->Transform(1, &p.x, &p.y)) return {kInfinity, kInfinity};
        if (mTurn > 0) p.x += mTurn * std::round((near.x - p.x) / mTurn);
        return p;
    }

private:
    struct Destroy {
        void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
    };
    std::unique_ptr<OGRCoordinateTransformation, Destroy> mTransform;
    double mTurn = 0;  // a full turn in the target's units; 0 where it has none
};

std::string geographicWkt(const std::string& wkt) {
    const OGRSpatialReference system = referenceSystem(wkt);
    const std::unique_ptr<OGRSpatialReference> geographic(system.CloneGeogCS());
    return geographic ? wktOf(*geographic) : std::string();
}

glm::dvec2 middlePixel(const Georeference& raster) {
    return 0.5 * glm::dvec2(raster.width, raster.height);
}

struct Box {
    glm::dvec2 min{kInfinity}, max{-kInfinity};
    void add(const glm::dvec2& p) {
        min = glm::dvec2(std::min(min.x, p.x), std::min(min.y, p.y));
        max = glm::dvec2(std::max(max.x, p.x), std::max(max.y, p.y));
    }
    glm::dvec2 size() const { return max - min; }
    double area() const { return size().x > 0 && size().y > 0 ? size().x * size().y : 0.0; }
};

// The four edges of the rectangle of pixel coordinates [a, b], each mapped and boxed.
template <typename Map>
std::array<Box, 4> mappedEdges(const glm::dvec2& a, const glm::dvec2& b, const Map& map) {
    std::array<Box, 4> edges;
    for (int k = 0; k < kEdgePoints; ++k) {
        const double t = k / double(kEdgePoints - 1);
        const glm::dvec2 p = a + t * (b - a);
        const glm::dvec2 ends[4] = {{p.x, a.y}, {p.x, b.y}, {a.x, p.y}, {b.x, p.y}};
        for (int e = 0; e < 4; ++e) {
            const glm::dvec2 q = map(ends[e]);
            if (std::isfinite(q.x) && std::isfinite(q.y)) edges[e].add(q);
        }
    }
    return edges;
}

Box around(const std::array<Box, 4>& edges) {
    Box box;
    for (const Box& edge : edges) {
        if (edge.min.x > edge.max.x) continue;  // nothing of it could be mapped
        box.add(edge.min);
        box.add(edge.max);
    }
    return box;
}

// Returns the box between the two edges lying west and east, and the two lying south and north.
Box inside(const std::array<Box, 4>& edges) {
    const auto before = [](const Box& a, const Box& b, int axis) {
        return a.min[axis] + a.max[axis] < b.min[axis] + b.max[axis];
    };
    Box box;
    for (int axis = 0; axis < 2; ++axis) {
        const auto low = std::min_element(edges.begin(), edges.end(),
                                          [&](const Box& a, const Box& b) { return before(a, b, axis); });
        const auto high = std::max_element(edges.begin(), edges.end(),
                                           [&](const Box& a, const Box& b) { return before(a, b, axis); });
        box.min[axis] = low->max[axis];
        box.max[axis] = high->min[axis];
    }
    return box;
}

// The system about the raster's middle, in metres; throws for rasters too wide to be flattened.
std::string localSystem(const Georeference& raster, const std::filesystem::path& file) {
    const std::string geographic = geographicWkt(raster.wkt);
    if (geographic.empty())
        throw Error(file.string(), "reference system",
                    "expected a geographic or projected one, got another kind",
                    "reproject the file, for example with gdalwarp -t_srs EPSG:32633");
    const PixelPlacement placement(raster);
    const glm::dvec2 middleReference = placement.fromPixel(middlePixel(raster));
    const ReferenceTransform toGeographic(raster.wkt, geographic, file);
    const glm::dvec2 middle = toGeographic(middleReference, middleReference);
    const auto edges = mappedEdges({0, 0}, {raster.width, raster.height}, [&](const glm::dvec2& p) {
        return toGeographic(placement.fromPixel(p), middle);
    });
    const OGRSpatialReference degrees = referenceSystem(geographic);
    const double toDegrees = degrees.GetAngularUnits() * 180 / std::numbers::pi;
    const Box box = around(edges);
    // Meridians are closest to each other at the end that is nearest to a pole, widest at the other.
    const double nearest =
        box.min.y <= 0 && box.max.y >= 0 ? 0.0 : std::min(std::abs(box.min.y), std::abs(box.max.y));
    glm::dvec2 size = box.size() * toDegrees;
    size.x *= std::cos(nearest * degrees.GetAngularUnits());
    if (!(size.x <= kWidestDegrees && size.y <= kWidestDegrees && std::isfinite(middle.x + middle.y)))
        throw Error(file.string(), "extent",
                    fmt::format("expected at most {:g} degrees a side on the ground, got {:.4g} x {:.4g}",
                                kWidestDegrees, size.x, size.y),
                    "cut out a part, for example with gdal_translate -projwin");
    OGRSpatialReference local;
    local.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    local.CopyGeogCSFrom(&degrees);
    local.SetTM(middle.y * toDegrees, middle.x * toDegrees, 1.0, 0.0, 0.0);
    local.SetLinearUnits("metre", 1.0);
    local.SetProjCS("local transverse Mercator");
    return wktOf(local);
}

// Steps east and north that keep the source's own density at its middle.
template <typename Map>
glm::dvec2 ownSteps(const Georeference& raster, const Map& map) {
    const glm::dvec2 middle = middlePixel(raster);
    const glm::dvec2 column = map(middle + glm::dvec2(0.5, 0)) - map(middle - glm::dvec2(0.5, 0));
    const glm::dvec2 row = map(middle + glm::dvec2(0, 0.5)) - map(middle - glm::dvec2(0, 0.5));
    constexpr double kLevel = 0.2;  // a raster turned by less keeps a step for each axis
    if (std::abs(column.y) < kLevel * std::abs(column.x)) return {glm::length(column), glm::length(row)};
    if (std::abs(column.x) < kLevel * std::abs(column.y)) return {glm::length(row), glm::length(column)};
    return glm::dvec2(std::min(glm::length(column), glm::length(row)));
}

// Returns the largest error, in the middle between nodes, of bilinear interpolation in steps of `step`
// pixels, over a lattice of places; pixels of the source.
template <typename Exact>
double mapError(const Georeference& target, const Exact& exact, int step) {
    constexpr int kPlaces = 9;
    double worst = 0;
    for (int b = 0; b < kPlaces; ++b)
        for (int a = 0; a < kPlaces; ++a) {
            const int i = (target.width - 1) * a / (kPlaces - 1) / step * step;
            const int j = (target.height - 1) * b / (kPlaces - 1) / step * step;
            const glm::dvec2 mean =
                0.25 * (exact(i, j) + exact(i + step, j) + exact(i, j + step) + exact(i + step, j + step));
            const double off = glm::length(mean - exact(i + 0.5 * step, j + 0.5 * step));
            if (std::isfinite(off)) worst = std::max(worst, off);
        }
    return worst;
}

// Nodes of a map 2^shift pixels apart: as wide as a hundredth of a pixel allows.
template <typename Exact>
int nodeShift(const Georeference& target, const Exact& exact) {
    constexpr double kMapTolerance = 0.01;
    constexpr long long kMostNodes = 1 << 24;  // 256 MB; finer maps are not made
    // More are mapped a run of rows at a time (PixelMapRows).
    constexpr long long kMostAtOnce = 1 << 28;
    const long long pixels = std::min(static_cast<long long>(target.width) * target.height, kMostAtOnce);
    for (const int shift : {4, 2})
        if (mapError(target, exact, 1 << shift) <= kMapTolerance || pixels >> (2 * shift - 4) > kMostNodes)
            return shift;
    return 0;
}

}  // namespace

double bodyRadiusOf(const Georeference& raster) {
    if (raster.wkt.empty() || !onEarth(raster)) return 0;
    const OGRSpatialReference system = referenceSystem(raster.wkt);
    OGRErr failed = OGRERR_NONE;
    const double a = system.GetSemiMajor(&failed);
    if (failed != OGRERR_NONE) return 0;
    const double b = system.GetSemiMinor(&failed);
    return failed == OGRERR_NONE && a > 0 && b > 0 ? (2 * a + b) / 3 : 0;
}

double fullTurnOf(const OGRSpatialReference& system) {
    if (system.IsGeographic()) return 2 * std::numbers::pi / system.GetAngularUnits();
    const char* const projection = system.IsProjected() ? system.GetAttrValue("PROJECTION") : nullptr;
    const auto isOneOf = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(),
                           [&](const char* name) { return EQUAL(projection, name); });
    };
    if (!projection ||
        !isOneOf({SRS_PT_MERCATOR_1SP, SRS_PT_MERCATOR_2SP, SRS_PT_MERCATOR_AUXILIARY_SPHERE,
                  SRS_PT_EQUIRECTANGULAR, SRS_PT_MILLER_CYLINDRICAL, SRS_PT_CYLINDRICAL_EQUAL_AREA}))
        return 0;
    OGRSpatialReference own(system);
    own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRSpatialReference> geographic(own.CloneGeogCS());
    if (!geographic) return 0;
    geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> way(
        OGRCreateCoordinateTransformation(geographic.get(), &own));
    if (!way) return 0;
    const double middle = own.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN, 0.0),
                 quarter = 0.5 * std::numbers::pi / geographic->GetAngularUnits();
    double x[2] = {middle - quarter, middle + quarter}, y[2] = {0, 0};
    if (!way->Transform(2, x, y) || !std::isfinite(x[1] - x[0])) return 0;
    return 2 * std::abs(x[1] - x[0]);
}

double metresPerUnit(const Georeference& raster) {
    if (raster.wkt.empty()) return 1.0;
    const OGRSpatialReference system = referenceSystem(raster.wkt);
    if (system.IsGeographic()) return 0.0;
    return system.GetLinearUnits();
}

glm::dvec2 groundScale(const Georeference& raster, const glm::dvec2& pixel) {
    const OGRSpatialReference system = referenceSystem(raster.wkt);
    const std::string geographic = system.IsProjected() ? geographicWkt(raster.wkt) : std::string();
    if (geographic.empty()) return glm::dvec2(1.0);
    const ReferenceTransform toGeographic(raster.wkt, geographic, {});
    const double toRadians = referenceSystem(geographic).GetAngularUnits();
    const double a = system.GetSemiMajor(), b = system.GetSemiMinor(), e2 = 1 - (b * b) / (a * a);
    // Straight through the ellipsoid, so that the poles are places as any other.
    const auto inSpace = [&](const glm::dvec2& p) {
        const glm::dvec2 g = toGeographic(p, {0, 0}) * toRadians;
        const double across = a / std::sqrt(1 - e2 * std::sin(g.y) * std::sin(g.y));
        return across * glm::dvec3(std::cos(g.y) * std::cos(g.x), std::cos(g.y) * std::sin(g.x),
                                   (1 - e2) * std::sin(g.y));
    };
    const PixelPlacement placement(raster);
    glm::dvec2 scale(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 step(0.0);
        step[axis] = 0.5;
        const glm::dvec2 from = placement.fromPixel(pixel - step), to = placement.fromPixel(pixel + step);
        const double ground = glm::length(inSpace(to) - inSpace(from));
        const double length = glm::length(to - from) * system.GetLinearUnits();
        if (std::isfinite(ground) && length > 0) scale[axis] = ground / length;
    }
    return scale;
}

bool onEarth(const Georeference& raster) {
    const OGRSpatialReference system = referenceSystem(raster.wkt);
    return system.IsProjected() || system.IsGeographic();
}

bool holdsPole(const Georeference& raster) {
    const OGRSpatialReference system = referenceSystem(raster.wkt);
    const std::string geographic = system.IsProjected() ? geographicWkt(raster.wkt) : std::string();
    if (geographic.empty()) return false;
    const ReferenceTransform toRaster(geographic, raster.wkt, {});
    const double quarter = 0.5 * std::numbers::pi / referenceSystem(geographic).GetAngularUnits();
    const PixelPlacement placement(raster);
    for (const double latitude : {quarter, -quarter}) {
        const glm::dvec2 pixel = placement.toPixel(toRaster({0, latitude}, {0, 0}));
        // A pole that the projection tears apart lies elsewhere on another meridian.
        const glm::dvec2 other = placement.toPixel(toRaster({quarter, latitude}, {0, 0}));
        if (pixel.x >= 0 && pixel.y >= 0 && pixel.x <= raster.width && pixel.y <= raster.height &&
            glm::length(other - pixel) < 1)
            return true;
    }
    return false;
}

Georeference metricGrid(const Georeference& raster, bool ownSystem, const std::filesystem::path& file) {
    Georeference grid;
    if (!raster.wkt.empty()) grid.wkt = ownSystem ? raster.wkt : localSystem(raster, file);
    const ReferenceTransform toGrid(raster.wkt, grid.wkt, file);
    const PixelPlacement placement(raster);
    const auto map = [&](const glm::dvec2& p) { return toGrid(placement.fromPixel(p), {0, 0}); };
    const auto edges = mappedEdges({0.5, 0.5}, {raster.width - 0.5, raster.height - 0.5}, map);
    const Box outer = around(edges), inner = inside(edges);
    const Box& box = inner.area() >= 0.9 * outer.area() ? inner : outer;
    const glm::dvec2 step = ownSteps(raster, map);
    const glm::dvec2 cells = box.size() / step;
    constexpr double kMostCells = 1e9;  // far beyond what checkRasterSize lets pass
    if (!(step.x > 0 && step.y > 0 && cells.x >= 0 && cells.y >= 0 && cells.x < kMostCells &&
          cells.y < kMostCells))
        throw Error(file.string(), "georeference", "can not be brought to metres",
                    "check the file's reference system and pixel size");
    grid.width = static_cast<int>(cells.x + 1e-6) + 1;
    grid.height = static_cast<int>(cells.y + 1e-6) + 1;
    const glm::dvec2 corner = 0.5 * (box.min + box.max) + 0.5 * glm::dvec2(-grid.width, grid.height) * step;
    grid.transform = {corner.x, step.x, 0, corner.y, 0, -step.y};
    return grid;
}

PixelMapRows::PixelMapRows(const Georeference& target, const Georeference& source,
                           const std::filesystem::path& file)
    : mWidth(target.width) {
    // The transforms that one place goes through. On the heap: a placement refers to its raster.
    struct Way {
        Way(const Georeference& t, const Georeference& s, const std::filesystem::path& f)
            : target(t), source(s), toSource(t.wkt, s.wkt, f), from(target), to(source) {
            near = to.fromPixel(middlePixel(source));
        }
        Georeference target, source;
        ReferenceTransform toSource;
        PixelPlacement from, to;
        glm::dvec2 near{0.0};
    };
    mExact = [way = std::make_shared<const Way>(target, source, file)](double column, double row) {
        return way->to.toPixel(way->toSource(way->from.fromPixel({column + 0.5, row + 0.5}), way->near));
    };
    mShift = nodeShift(target, mExact);
}

PixelMap PixelMapRows::map(int first, int rows) const {
    const int step = 1 << mShift, nodesX = (mWidth - 1) / step + 2, nodesY = (rows - 1) / step + 2;
    std::vector<glm::dvec2> nodes;
    nodes.reserve(static_cast<std::size_t>(nodesX) * nodesY);
    for (int j = 0; j < nodesY; ++j)
        for (int i = 0; i < nodesX; ++i) nodes.push_back(mExact(i * step, first + j * step));
    return PixelMap(nodesX, std::move(nodes), mShift);
}

PixelMap mapPixels(const Georeference& target, const Georeference& source,
                   const std::filesystem::path& file) {
    return PixelMapRows(target, source, file).map(0, target.height);
}

bool overlap(const Georeference& a, const Georeference& b, const std::filesystem::path& file) {
    const ReferenceTransform toA(b.wkt, a.wkt, file);
    const PixelPlacement from(b), to(a);
    const glm::dvec2 near = to.fromPixel(middlePixel(a));
    const Box box = around(mappedEdges({0, 0}, {b.width, b.height}, [&](const glm::dvec2& p) {
        return to.toPixel(toA(from.fromPixel(p), near));
    }));
    return box.min.x < a.width && box.min.y < a.height && box.max.x > 0 && box.max.y > 0;
}

}  // namespace stereonav
