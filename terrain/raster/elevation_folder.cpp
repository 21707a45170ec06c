#include "terrain/raster/elevation_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "engine/base/file.h"

namespace stereonav {
namespace {

std::string lowered(std::string name) {
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

bool isElevationName(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 13> kExtensions{".tif", ".tiff", ".hgt", ".dem", ".asc",
                                                           ".dt0", ".dt1",  ".dt2", ".img", ".bil",
                                                           ".flt", ".bt",   ".nc"};
    const std::string extension = lowered(file.extension().string());
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() ||
           isPackedHeights(file);
}

}  // namespace

bool isPackedHeights(const std::filesystem::path& file) {
    const std::string name = lowered(file.filename().string());
    return name.ends_with(".hgt.zip") || name.ends_with(".hgt.gz");
}

std::vector<std::filesystem::path> elevationFilesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
        if (!isHiddenFile(entry.path()) && isElevationName(entry.path()) && entry.is_regular_file(failed))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace stereonav
