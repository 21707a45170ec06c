// The XML of virtual rasters, walked before GDAL opens what it names.
#include "terrain/read/gdal/vrt_check.h"

#include <cpl_minixml.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr int kDeepest = 8;                         // virtual rasters of virtual rasters
constexpr std::uintmax_t kLargestText = 100 << 20;  // bytes

struct DestroyXml {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

bool isVirtualRaster(const std::filesystem::path& file) {
    std::string begin(200, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin.find("<VRTDataset") != std::string::npos;
}

// Whether an element's text is the name of another file, or of another place.
bool namesFile(std::string_view element) {
    for (const std::string_view end : {"Filename", "Dataset", "FileName", "ServerURL", "Url"})
        if (element.ends_with(end) && element != "VRTDataset") return true;
    return false;
}

class VrtWalk {
public:
    explicit VrtWalk(const std::filesystem::path& file) : mFirst(file) {}

    void check(const std::filesystem::path& file, int depth) {
        if (!isVirtualRaster(file)) return;
        if (depth > kDeepest)
            fail("expected files, found virtual rasters that name each other", "name files in them");
        std::error_code code;
        if (std::filesystem::file_size(file, code) > kLargestText || code)
            fail("expected at most 100 MB of text", "name fewer files");
        const std::unique_ptr<CPLXMLNode, DestroyXml> root(CPLParseXMLFile(file.string().c_str()));
        if (!root)
            fail("expected a virtual raster, found damaged XML",
                 "make it anew, for example with gdalbuildvrt");
        for (const CPLXMLNode* node = root.get(); node; node = node->psNext) walk(*node, file, false, depth);
    }

    std::vector<std::filesystem::path> named() && { return std::move(mNamed); }

private:
    [[noreturn]] void fail(const std::string& problem, const std::string& advice) const {
        throw Error(mFirst.string(), "", problem, advice);
    }

    void walk(const CPLXMLNode& node, const std::filesystem::path& file, bool raw, int depth) {
        raw |= std::string_view(CPLGetXMLValue(&node, "subClass", "")) == "VRTRawRasterBand";
        if (node.eType == CXT_Element && namesFile(node.pszValue)) checkName(node, file, raw, depth);
        for (const CPLXMLNode* child = node.psChild; child; child = child->psNext)
            if (child->eType == CXT_Element) walk(*child, file, raw, depth);
    }

    void checkName(const CPLXMLNode& node, const std::filesystem::path& file, bool raw, int depth) {
        const std::string name = CPLGetXMLValue(&node, nullptr, "");
        if (name.empty()) return;
        if (namesNetwork(name))
            fail("expected names of local files, found \"" + name + "\"", "fetch it first and name the copy");
        const bool relative = std::string_view(CPLGetXMLValue(&node, "relativeToVRT", "0")) != "0";
        const std::filesystem::path other =
            relative ? file.parent_path() / name : std::filesystem::path(name);
        if (!std::filesystem::is_regular_file(other))
            fail("names \"" + name + "\", and there is no such file",
                 "put it there, or make the virtual raster anew");
        mNamed.push_back(other);
        if (raw) return;  // numbers without a format
        if (!GDALIdentifyDriverEx(other.string().c_str(), GDAL_OF_RASTER, rasterDrivers(), nullptr))
            fail("names \"" + name + "\", and that is no raster of a format read here",
                 "convert it to GeoTIFF, for example with gdal_translate");
        check(other, depth + 1);
    }

    const std::filesystem::path& mFirst;
    std::vector<std::filesystem::path> mNamed;
};

}  // namespace

bool namesNetwork(const std::filesystem::path& path) {
    const std::string name = path.string();
    if (name.starts_with("/vsi")) return true;
    // A folder before it leaves one slash of two.
    for (const char* scheme : {"http:/", "https:/", "ftp:/", "s3:/", "gs:/", "/vsicurl", "/vsis3", "/vsigs"})
        if (name.find(scheme) != std::string::npos) return true;
    return name.find("://") != std::string::npos;
}

void checkVirtualRaster(const std::filesystem::path& file) {
    VrtWalk(file).check(file, 0);
}

std::vector<std::filesystem::path> filesOfVirtualRaster(const std::filesystem::path& file) {
    VrtWalk walk(file);
    walk.check(file, 0);
    return std::move(walk).named();
}

const char* const* rasterDrivers() {
    static const char* const kDrivers[] = {"GTiff", "SRTMHGT",     "USGSDEM", "AAIGrid", "GRASSASCIIGrid",
                                           "DTED",  "EHdr",        "HFA",     "ENVI",    "SAGA",
                                           "GSAG",  "GSBG",        "GS7BG",   "BT",      "WEBP",
                                           "GIF",   "JP2OpenJPEG", "PNG",     "JPEG",    "BMP",
                                           "GPKG",  "MBTiles",     "netCDF",  "VRT",     nullptr};
    return kDrivers;
}

}  // namespace stereonav
