// GeoTIFF through GDAL: deflated strips of one band, placed as the terrain's own samples.
#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <vector>

#include "engine/base/error.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr const char* kOptions[] = {"COMPRESS=DEFLATE", "ZLEVEL=1", "BIGTIFF=IF_SAFER", nullptr};

// North first, as files have them.
template <typename T>
bool writeRows(GDALRasterBand& band, const Plane<T>& plane, GDALDataType type) {
    for (int y = 0; y < plane.height(); ++y) {
        const T* row = plane.row(plane.height() - 1 - y);
        if (band.RasterIO(GF_Write, 0, y, plane.width(), 1, const_cast<T*>(row), plane.width(), 1, type, 0,
                          0) != CE_None)
            return false;
    }
    return true;
}

bool place(GDALDataset& dataset, const Georeference& grid) {
    std::array<double, 6> transform = grid.transform;
    if (dataset.SetGeoTransform(transform.data()) != CE_None) return false;
    if (grid.wkt.empty()) return true;
    OGRSpatialReference system;
    if (system.importFromWkt(grid.wkt.c_str()) != OGRERR_NONE) return false;
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return dataset.SetSpatialRef(&system) == CE_None;
}

}  // namespace

void writeGeoTiff(const std::filesystem::path& file, const Georeference& grid, const WrittenRaster& raster) {
    GdalMessages messages;
    const int width = raster.bytes ? raster.bytes->width() : raster.floats->width(),
              height = raster.bytes ? raster.bytes->height() : raster.floats->height();
    const auto fail = [&] {
        throw Error(file.string(), "", "can not be written" + messages.reason(file), "is the disk full?");
    };
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (!driver) fail();
    GdalDataset dataset(driver->Create(file.string().c_str(), width, height, 1,
                                       raster.bytes ? GDT_Byte : GDT_Float32, const_cast<char**>(kOptions)));
    if (!dataset || !place(*dataset, grid)) fail();
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    band.SetNoDataValue(raster.missing);
    if (!raster.description.empty()) band.SetDescription(raster.description.c_str());
    if (!raster.unit.empty()) band.SetUnitType(raster.unit.c_str());
    const bool written = raster.bytes ? writeRows(band, *raster.bytes, GDT_Byte)
                                      : writeRows(band, *raster.floats, GDT_Float32);
    dataset->FlushCache();
    dataset.reset();  // writes what is left
    if (!written || messages.hasError()) fail();
}

}  // namespace stereonav
