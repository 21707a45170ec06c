// Centrelines as VTK's XML poly data in ASCII, the form that the vascular modelling toolkit reads and writes:
// one piece, one polyline a segment, radii as point data, the segments' numbers as cell data.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "colon/centreline/centreline_formats.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kPolyDataAdvice = "write the centreline again";
constexpr std::size_t kLongestName = 40;  // of what a message repeats

void appendArray(std::string& text, const std::string& type, const std::string& name, int components,
                 const std::string& values) {
    text += fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}"
        "        </DataArray>\n",
        type, name, components, values);
}

struct Tag {
    std::string name;  // "/X" closes X
    std::map<std::string, std::string> attributes;
    std::size_t begin = 0, end = 0;  // of the tag in the text
};

// The tags of the forms above, one after another; comments and declarations are skipped. Entities and CDATA
// do not occur in them.
class Tags {
public:
    Tags(const std::string& text, const std::string& file) : mText(text), mFile(file) {}

    bool next(Tag& tag) {
        for (;;) {
            const std::size_t begin = mText.find('<', mAt);
            if (begin == std::string::npos) return false;
            const bool comment = mText.compare(begin, 4, "<!--") == 0;
            const std::size_t end = mText.find(comment ? "-->" : ">", begin);
            if (end == std::string::npos) fail(begin, "a tag is cut off");
            mAt = end + (comment ? 3 : 1);
            const auto behind = static_cast<std::ptrdiff_t>(mAt);
            mLine +=
                static_cast<std::size_t>(std::count(mText.begin() + mCounted, mText.begin() + behind, '\n'));
            mCounted = behind;
            if (comment || mText[begin + 1] == '?' || mText[begin + 1] == '!') continue;
            tag = parsed(begin, end);
            return true;
        }
    }
    // The one that the last tag ends in.
    std::size_t nextLine() const { return mLine; }
    [[noreturn]] void fail(std::size_t at, const std::string& problem) const {
        const auto line =
            1 + std::count(mText.begin(), mText.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw Error(mFile, std::to_string(line), problem, kPolyDataAdvice);
    }

private:
    Tag parsed(std::size_t begin, std::size_t end) const {
        Tag tag;
        tag.begin = begin;
        tag.end = end + 1;
        constexpr const char* kSpace = " \t\r\n/";
        std::size_t at = std::min(mText.find_first_of(" \t\r\n>", begin), end);
        tag.name = mText.substr(begin + 1, at - begin - 1);
        while ((at = mText.find_first_not_of(kSpace, at)) < end) {
            const std::size_t equals = mText.find('=', at);
            if (equals >= end || equals + 1 >= end) fail(begin, "expected attributes as name=\"value\"");
            const char quote = mText[equals + 1];
            const std::size_t close = mText.find(quote, equals + 2);
            if ((quote != '"' && quote != '\'') || close >= end) fail(begin, "expected attributes in quotes");
            tag.attributes[mText.substr(at, equals - at)] = mText.substr(equals + 2, close - equals - 2);
            at = close + 1;
        }
        return tag;
    }

    const std::string& mText;
    const std::string& mFile;
    std::size_t mAt = 0, mLine = 1;
    std::ptrdiff_t mCounted = 0;  // characters, whose line ends are in mLine
};

std::string attribute(const Tag& tag, const std::string& name) {
    const auto found = tag.attributes.find(name);
    return found == tag.attributes.end() ? std::string() : found->second;
}

std::vector<double> arrayValues(const Tags& tags, const Tag& tag, const std::string& text,
                                const std::string& file) {
    const std::string name = attribute(tag, "Name"), format = attribute(tag, "format");
    if (format != "ascii")
        tags.fail(tag.begin, fmt::format("expected array \"{}\" in format ascii, got \"{}\"",
                                         name.substr(0, kLongestName), format.substr(0, kLongestName)));
    const std::size_t end = std::min(text.find('<', tag.end), text.size());
    NumberText words(file, std::string_view(text).substr(tag.end, end - tag.end), tags.nextLine());
    const std::string what = name.empty() ? "a coordinate" : name.substr(0, kLongestName);
    std::vector<double> values;
    while (!words.atEnd()) values.push_back(words.number(what));
    return values;
}

// The arrays of the one piece by "section/name"; of points, by "Points".
using Arrays = std::map<std::string, std::vector<double>>;

Arrays readArrays(const std::string& text, const std::string& file) {
    Tags tags(text, file);
    Arrays arrays;
    std::string section;
    int pieces = 0;
    bool poly = false, closed = false;
    for (Tag tag; tags.next(tag);) {
        if (tag.name == "VTKFile") poly = attribute(tag, "type") == "PolyData";
        if (tag.name == "/VTKFile") closed = true;
        if (tag.name == "Piece" && ++pieces > 1) tags.fail(tag.begin, "expected one piece, found more");
        if (tag.name == "Points" || tag.name == "Lines" || tag.name == "PointData" || tag.name == "CellData")
            section = tag.name;
        if (tag.name == "/" + section) section.clear();
        if (tag.name != "DataArray" || section.empty()) continue;
        const std::string key = section == "Points" ? section : section + "/" + attribute(tag, "Name");
        if (key == "Points" || section == "Lines" || key == std::string("PointData/") + kRadiusArray ||
            key == std::string("CellData/") + kSegmentArray)
            arrays[key] = arrayValues(tags, tag, text, file);
    }
    if (!poly)
        throw Error(file, "", "expected <VTKFile type=\"PolyData\">, found none",
                    "give a centreline as VTK poly data in XML");
    if (!closed)
        throw Error(file, "", "expected </VTKFile> at the end, the file is cut off", kPolyDataAdvice);
    return arrays;
}

const std::vector<double>& needed(const Arrays& arrays, const std::string& key, const std::string& file) {
    const auto found = arrays.find(key);
    if (found == arrays.end())
        throw Error(file, "", "expected an array " + key + ", found none", "write the centreline with it");
    return found->second;
}

std::vector<std::vector<std::size_t>> linesOf(const std::vector<double>& connectivity,
                                              const std::vector<double>& offsets, const std::string& file) {
    std::vector<std::vector<std::size_t>> lines;
    std::size_t at = 0;
    for (const double offset : offsets) {
        if (!(offset >= static_cast<double>(at) && offset <= static_cast<double>(connectivity.size())))
            throw Error(
                file, "\"offsets\"",
                fmt::format("expected numbers that rise to {}, got {:g}", connectivity.size(), offset),
                kPolyDataAdvice);
        lines.emplace_back();
        for (; at < static_cast<std::size_t>(offset); ++at) {
            if (!(connectivity[at] >= 0 && connectivity[at] < 1e15))
                throw Error(file, "\"connectivity\"", fmt::format("there is no point {:g}", connectivity[at]),
                            kPolyDataAdvice);
            lines.back().push_back(static_cast<std::size_t>(connectivity[at]));
        }
    }
    return lines;
}

}  // namespace

std::string vtpText(const Centreline& line) {
    const std::vector<std::size_t> starts = segmentStarts(line);
    std::string points, radii, segments, connectivity, offsets;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const CentrelinePoint& p = line.points[n];
        points += fmt::format("{:.12g} {:.12g} {:.12g}\n", p.position.x * 1e3, p.position.y * 1e3,
                              p.position.z * 1e3);
        radii += fmt::format("{:.12g}\n", p.radius * 1e3);
        connectivity += fmt::format("{}\n", n);
    }
    for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
        segments += fmt::format("{}\n", line.points[starts[k]].segment);
        offsets += fmt::format("{}\n", starts[k + 1]);
    }
    std::string text =
        "<?xml version=\"1.0\"?>\n<!-- stereonav centreline in millimetres, SPACE=LPS -->\n"
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <PolyData>\n";
    text += fmt::format(
        "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <PointData Scalars=\"{}\">\n",
        line.points.size(), starts.size() - 1, kRadiusArray);
    appendArray(text, "Float64", kRadiusArray, 1, radii);
    text += "      </PointData>\n      <CellData>\n";
    appendArray(text, "Int32", kSegmentArray, 1, segments);
    text += "      </CellData>\n      <Points>\n";
    appendArray(text, "Float64", "Points", 3, points);
    text += "      </Points>\n      <Lines>\n";
    appendArray(text, "Int64", "connectivity", 1, connectivity);
    appendArray(text, "Int64", "offsets", 1, offsets);
    return text + "      </Lines>\n    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

Centreline centrelineFromVtp(const std::string& text, const std::string& file) {
    const Arrays arrays = readArrays(text, file);
    PolyLines poly;
    poly.coordinates = needed(arrays, "Points", file);
    if (poly.coordinates.empty()) throw Error(file, "", "expected points, found none", kPolyDataAdvice);
    poly.radii = needed(arrays, std::string("PointData/") + kRadiusArray, file);
    poly.lines =
        linesOf(needed(arrays, "Lines/connectivity", file), needed(arrays, "Lines/offsets", file), file);
    if (const auto found = arrays.find(std::string("CellData/") + kSegmentArray); found != arrays.end())
        poly.segments = found->second;
    return centrelineFrom(poly, file);
}

}  // namespace stereonav
