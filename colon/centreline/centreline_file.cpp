// Centrelines as files: plain text here, poly data in centreline_vtk.cpp and centreline_vtp.cpp.
#include <fmt/format.h>

#include <cmath>

#include "colon/centreline/centreline_formats.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

constexpr const char* kAdvice = "write the centreline again";

std::string textOf(const Centreline& line) {
    std::string text = "# x y z radius segment; patient's axes (LPS), millimetres\n";
    for (const CentrelinePoint& p : line.points)
        text += fmt::format("{:.12g} {:.12g} {:.12g} {:.12g} {}\n", p.position.x * 1e3, p.position.y * 1e3,
                            p.position.z * 1e3, p.radius * 1e3, p.segment);
    return text;
}

Centreline fromText(const std::string& text, const std::string& file) {
    PolyLines poly;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view row(text.data() + at, end - at);
        at = end + 1;
        ++number;
        NumberText words(file, withoutComment(row), number);
        if (words.atEnd()) continue;
        for (int n = 0; n < 3; ++n) poly.coordinates.push_back(words.number("x y z radius segment"));
        poly.radii.push_back(words.number("x y z radius segment"));
        const double segment = words.number("x y z radius segment");
        if (!words.atEnd())
            words.fail(fmt::format("expected 5 numbers in a line, got also \"{}\"", words.word()));
        if (poly.segments.empty() || poly.segments.back() != segment) {
            poly.segments.push_back(segment);
            poly.lines.emplace_back();
        }
        poly.lines.back().push_back(poly.radii.size() - 1);
    }
    return centrelineFrom(poly, file);
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

bool NumberText::atEnd() {
    while (mAt < mText.size() && kBlanks.find(mText[mAt]) != std::string_view::npos) ++mAt;
    return mAt == mText.size();
}

std::string_view NumberText::word() {
    const bool none = atEnd();
    mWord = mAt;
    if (none) return {};
    mAt = std::min(mText.find_first_of(kBlanks, mAt), mText.size());
    return mText.substr(mWord, mAt - mWord);
}

double NumberText::number(const std::string& what) {
    const std::string_view next = word();
    if (next.empty()) fail("expected a number (" + what + "), found the end");
    const std::optional<double> value = numberOf(next);
    if (!value || !std::isfinite(*value))
        fail(fmt::format("expected a number ({}), got \"{}\"", what, next.substr(0, 40)));
    return *value;
}

std::size_t NumberText::count(const std::string& what) {
    const double value = number(what);
    if (!(value >= 0) || value != std::floor(value))
        fail(fmt::format("expected a count ({}), got {:g}", what, value));
    if (value > static_cast<double>(mText.size() - mAt) / 2 + 1)
        fail(fmt::format("expected {:.0f} ({}), but the file is too short for them", value, what));
    return static_cast<std::size_t>(value);
}

std::string NumberText::line() const {
    std::size_t line = mFirstLine;
    for (std::size_t n = 0; n < std::min(mWord, mText.size()); ++n) line += mText[n] == '\n';
    return std::to_string(line);
}

void NumberText::fail(const std::string& problem) const {
    throw Error(mFile, line(), problem, kAdvice);
}

std::vector<std::size_t> segmentStarts(const Centreline& line) {
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n < line.points.size(); ++n)
        if (n == 0 || line.points[n].segment != line.points[n - 1].segment) starts.push_back(n);
    starts.push_back(line.points.size());
    return starts;
}

Centreline centrelineFrom(const PolyLines& poly, const std::string& file) {
    const std::size_t count = poly.coordinates.size() / 3;
    if (count == 0) throw Error(file, "", "expected points, found none", kAdvice);
    if (poly.radii.size() != count || poly.coordinates.size() != 3 * count)
        throw Error(file, std::string("\"") + kRadiusArray + "\"",
                    fmt::format("expected {} radii for {} coordinates, got {}", count,
                                poly.coordinates.size(), poly.radii.size()),
                    kAdvice);
    if (poly.lines.empty()) throw Error(file, "", "expected a line through the points, found none", kAdvice);
    if (!poly.segments.empty() && poly.segments.size() != poly.lines.size())
        throw Error(
            file, std::string("\"") + kSegmentArray + "\"",
            fmt::format("expected {} numbers, one a line, got {}", poly.lines.size(), poly.segments.size()),
            kAdvice);
    Centreline result;
    for (std::size_t k = 0; k < poly.lines.size(); ++k) {
        const double segment = poly.segments.empty() ? static_cast<double>(k + 1) : poly.segments[k];
        if (!(segment >= 1 && segment <= 1e6) || segment != std::floor(segment))
            throw Error(file, "", fmt::format("expected segments numbered from 1, got {:g}", segment),
                        kAdvice);
        for (const std::size_t n : poly.lines[k]) {
            if (n >= count)
                throw Error(file, "", fmt::format("line {} goes through point {} of {}", k + 1, n, count),
                            kAdvice);
            if (!(poly.radii[n] >= 0))
                throw Error(file, "", fmt::format("expected radii of 0 or more, got {:g}", poly.radii[n]),
                            kAdvice);
            const double* p = &poly.coordinates[3 * n];
            result.points.push_back(
                {glm::dvec3(p[0], p[1], p[2]) * 1e-3, poly.radii[n] * 1e-3, static_cast<int>(segment)});
        }
    }
    if (result.points.empty()) throw Error(file, "", "expected points on a line, found none", kAdvice);
    return result;
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

Centreline readCentreline(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file), text = readTextFile(file), name = file.string();
    if (extension == ".txt") return fromText(text, name);
    return extension == ".vtk" ? centrelineFromVtk(text, name) : centrelineFromVtp(text, name);
}

}  // namespace stereonav
