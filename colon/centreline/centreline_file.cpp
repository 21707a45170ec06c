// Centrelines as files: plain text here, poly data in centreline_vtk.cpp and centreline_vtp.cpp.
#include <fmt/format.h>

#include "colon/centreline/centreline_formats.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

std::string textOf(const Centreline& line) {
    std::string text = "# x y z radius segment; patient's axes (LPS), millimetres\n";
    for (const CentrelinePoint& p : line.points)
        text += fmt::format("{:.12g} {:.12g} {:.12g} {:.12g} {}\n", p.position.x * 1e3, p.position.y * 1e3,
                            p.position.z * 1e3, p.radius * 1e3, p.segment);
    return text;
}

std::string lowerExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

std::string extensionOf(const std::filesystem::path& file) {
    if (!isCentrelineFileName(file))
        throw Error(file.string(), "",
                    "expected a name ending in .txt, .vtp or .vtk, got \"" + file.extension().string() + "\"",
                    "name it centreline.vtp");
    return lowerExtension(file);
}

}  // namespace

std::vector<std::size_t> segmentStarts(const Centreline& line) {
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n < line.points.size(); ++n)
        if (n == 0 || line.points[n].segment != line.points[n - 1].segment) starts.push_back(n);
    starts.push_back(line.points.size());
    return starts;
}

bool isCentrelineFileName(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    return extension == ".txt" || extension == ".vtp" || extension == ".vtk";
}

void writeCentreline(const std::filesystem::path& file, const Centreline& line) {
    const std::string extension = isStandardOutput(file) ? ".txt" : extensionOf(file);
    if (line.points.empty())
        throw Error(file.string(), "", "the centreline has no points to write", "find it first");
    writeTextFile(file, extension == ".txt"   ? textOf(line)
                        : extension == ".vtk" ? vtkText(line)
                                              : vtpText(line));
}

}  // namespace stereonav
