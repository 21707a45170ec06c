// The XML of virtual rasters, walked by GDAL's own rules before it opens what they name: names of elements
// and attributes in any capitals, an attribute as good as an element, the root anywhere.
#include "terrain/read/gdal/vrt_check.h"

#include <cpl_minixml.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "terrain/read/gdal/reference_files.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr int kDeepest = 8;                         // virtual rasters of virtual rasters
constexpr int kDeepestElement = 64;                 // elements within elements
constexpr std::uintmax_t kLargestText = 100 << 20;  // bytes

struct DestroyXml {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using Xml = std::unique_ptr<CPLXMLNode, DestroyXml>;

// The driver that takes the file first; "" for none.
std::string_view driverOf(const fs::path& file) {
    GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, rasterDrivers(), nullptr);
    return driver ? GDALGetDescription(driver) : "";
}

bool endsWith(const char* text, const char* end) {
    const std::size_t length = std::string_view(text).size(), needed = std::string_view(end).size();
    return length >= needed && EQUAL(text + length - needed, end);
}

// Returns whether the value of an element or attribute is the name of another file.
bool namesFile(const char* called) {
    return (endsWith(called, "Filename") || endsWith(called, "Dataset")) && !EQUAL(called, "VRTDataset");
}

// GDAL takes the folder of the file that links lead to.
fs::path folderOf(const fs::path& file) {
    std::error_code code;
    const fs::path whole = fs::canonical(file, code);
    return (code ? file : whole).parent_path();
}

class VrtWalk {
public:
    // ofFiles: whether what it names is looked at, and what that names.
    VrtWalk(const fs::path& file, bool ofFiles) : mFirst(file), mOfFiles(ofFiles) {}

    void check(const fs::path& file, int depth) {
        if (depth > kDeepest)
            fail("expected files, found virtual rasters that refer to each other", "name files in them");
        std::error_code code;
        const std::uintmax_t bytes = fs::file_size(file, code);
        if (code) fail("found a virtual raster that is no plain file", "unpack it");
        if (bytes > kLargestText) fail("expected at most 100 MB of text", "name fewer files");
        const Xml root(CPLParseXMLFile(file.c_str()));
        if (!root)
            fail("expected a virtual raster, found damaged XML",
                 "create it again, for example with gdalbuildvrt");
        const Place place{folderOf(file), depth};
        for (const CPLXMLNode* node = root.get(); node; node = node->psNext) walk(*node, place, false, 0);
    }

    VirtualRasterFiles files() && { return std::move(mFiles); }

private:
    struct Place {
        fs::path folder;  // folder of the virtual raster
        int depth;
    };

    [[noreturn]] void fail(const std::string& problem, const std::string& advice) const {
        throw Error(mFirst.string(), "", problem, advice);
    }

    void walk(const CPLXMLNode& node, const Place& place, bool raw, int nested) {
        if (nested > kDeepestElement)
            fail(fmt::format("expected at most {} elements within each other", kDeepestElement),
                 "create it again, for example with gdalbuildvrt");
        if (EQUAL(node.pszValue, "Metadata")) return;  // GDAL opens nothing of it, or says so as it does
        raw |= EQUAL(CPLGetXMLValue(&node, "subClass", ""), "VRTRawRasterBand");
        checkReferenceText(node, mFirst.string());
        if (namesFile(node.pszValue)) checkName(node, place, raw);
        for (const CPLXMLNode* child = node.psChild; child; child = child->psNext)
            if (child->eType == CXT_Element || child->eType == CXT_Attribute)
                walk(*child, place, raw, nested + 1);
    }

    // Where it may lie: relative to the virtual raster or to the working folder, as the name's own flag says;
    // GDAL's readers differ in what they take where the flag is left out.
    static std::vector<fs::path> candidates(const std::string& name, const char* flag, bool raw,
                                            const fs::path& folder) {
        if (name.starts_with('/')) return {name};
        if (flag && std::atoi(flag) != 0) return {folder / name};
        if (flag ? std::string_view(flag) == "0" : !raw) return {name};
        return {name, folder / name};
    }

    void checkName(const CPLXMLNode& node, const Place& place, bool raw) {
        const std::string name = CPLGetXMLValue(&node, nullptr, "");
        if (name.empty()) return;
        if (namesNetwork(name))
            fail("expected names of local files, found \"" + name + "\"", "fetch it first and name the copy");
        bool found = false;
        for (const fs::path& file :
             candidates(name, CPLGetXMLValue(&node, "relativeToVRT", nullptr), raw, place.folder)) {
            std::error_code code;
            if (!fs::is_regular_file(file, code)) continue;
            found = true;
            checkFile(name, file, place, raw);
        }
        if (!found && mOfFiles)
            fail("names \"" + name + "\", and there is no such file",
                 "put it there, or create the virtual raster again");
    }

    void checkFile(const std::string& name, const fs::path& file, const Place& place, bool raw) {
        const bool below = liesBelow(place.folder, file);
        if (raw && !below)
            fail("reads \"" + name + "\" as plain numbers, which lies outside its folder",
                 "put that file beside it and name it without a folder");
        mFiles.all.push_back(file);
        if (!below) mFiles.outside.push_back(file);
        if (raw || !mOfFiles) return;
        const std::string_view driver = driverOf(file);
        if (driver.empty())
            fail("names \"" + name + "\", and that is no raster of a format read here",
                 "convert it to GeoTIFF, for example with gdal_translate");
        if (driver == "VRT") check(file, place.depth + 1);
    }

    const fs::path& mFirst;
    const bool mOfFiles;
    VirtualRasterFiles mFiles;
};

}  // namespace

bool namesNetwork(const fs::path& path) {
    const std::string name = path.string();
    if (name.starts_with("/vsi")) return true;
    // A folder before it leaves one slash of two.
    for (const char* scheme : {"http:/", "https:/", "ftp:/", "s3:/", "gs:/", "/vsicurl", "/vsis3", "/vsigs"})
        if (name.find(scheme) != std::string::npos) return true;
    return name.find("://") != std::string::npos;
}

bool liesBelow(const fs::path& folder, const fs::path& file) {
    std::error_code noFolder, noFile;
    const fs::path from = fs::canonical(folder, noFolder), to = fs::canonical(file, noFile);
    if (noFolder || noFile) return false;
    const fs::path way = to.lexically_relative(from);
    return !way.empty() && *way.begin() != "..";
}

VirtualRasterFiles filesOfVirtualRaster(const fs::path& file) {
    if (driverOf(file) != "VRT") return {};
    VrtWalk walk(file, true);
    walk.check(file, 0);
    return std::move(walk).files();
}

std::string outsideNote(const fs::path& file, const VirtualRasterFiles& files) {
    if (files.outside.empty()) return "";
    const std::size_t more = files.outside.size() - 1;
    return fmt::format("{}: reads {}{}, outside its folder", file.string(), files.outside.front().string(),
                       more == 0 ? "" : fmt::format(" and {} more", more));
}

void checkOpenedVirtualRaster(const fs::path& file) {
    VrtWalk(file, false).check(file, 0);
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
