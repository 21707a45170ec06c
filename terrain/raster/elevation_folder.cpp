#include "terrain/raster/elevation_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace stereonav {

std::vector<std::filesystem::path> elevationFilesIn(const std::filesystem::path& folder) {
    constexpr std::array<std::string_view, 12> kExtensions{".tif", ".tiff", ".hgt", ".dem", ".asc", ".dt0",
                                                           ".dt1", ".dt2",  ".img", ".bil", ".flt", ".bt"};
    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        std::string extension = entry.path().extension().string();
        for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() &&
            entry.is_regular_file(failed))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace stereonav
