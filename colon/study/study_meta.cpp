// MetaImage headers (.mha, and .mhd with the samples beside it): itk.org's MetaIO.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "colon/study/study_header.h"
#include "colon/study/study_text.h"
#include "engine/base/regular_file.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr int kMostMetaAxes = 10;  // axes that MetaIO knows

struct MetaText {
    fs::path file;
    std::map<std::string, std::string> values;  // by name in small letters; the last of several counts
    std::vector<double> size, spacing, origin, directions;
    std::string text;
    std::size_t end = 0;  // end of the header in `text`
    int axes = 0;

    std::string value(const std::string& name) const {
        const auto at = values.find(name);
        return at == values.end() ? "" : at->second;
    }
    bool isTrue(const std::string& name) const {
        const std::string word = loweredText(value(name));
        return word.starts_with("t") || word.starts_with("1");
    }
    [[noreturn]] void refuse(int line, const std::string& problem) const {
        throw Error(file.string(), line > 0 ? std::to_string(line) : "", problem, "correct it in the header");
    }
    void take(int line, const std::string& key, const std::string& value);
};

bool anyOf(const std::string& key, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return key == name; });
}

void MetaText::take(int line, const std::string& key, const std::string& text_) {
    if (!key.empty()) values[key] = text_;
    if (key == "ndims") {
        const auto numbers = numbersIn(text_);
        if (numbers.empty() || !(numbers[0] >= 1 && numbers[0] <= kMostMetaAxes))
            refuse(line,
                   fmt::format("expected 1 to {} axes in NDims, found {}", kMostMetaAxes, shortText(text_)));
        axes = static_cast<int>(numbers[0]);
    }
    const bool isSize = key == "dimsize", isSpacing = anyOf(key, {"elementspacing", "elementsize"});
    const bool isOrigin = anyOf(key, {"offset", "position", "origin"});
    const bool isDirection = anyOf(key, {"transformmatrix", "rotation", "orientation"});
    if (!isSize && !isSpacing && !isOrigin && !isDirection) return;
    if (axes == 0) refuse(line, "expected NDims, the number of axes, above this line");
    auto numbers = numbersIn(text_);
    const auto expected = static_cast<std::size_t>(isDirection ? axes * axes : axes);
    if (numbers.size() < expected)
        refuse(line, fmt::format("expected {} numbers, found {}", expected, numbers.size()));
    numbers.resize(expected);
    for (const double number : numbers) {
        const std::string found = shortText(text_);
        if (isSpacing && !(std::isfinite(number) && number > 0))
            refuse(line, "expected a spacing of numbers above 0, found " + found);
        if (isSize && !(number >= 1 && number < 1e18)) refuse(line, "expected sizes above 0, found " + found);
        if (!std::isfinite(number)) refuse(line, "expected numbers, found " + found);
    }
    if (isSpacing && key == "elementsize" && values.contains("elementspacing")) return;
    (isSize ? size : isSpacing ? spacing : isOrigin ? origin : directions) = std::move(numbers);
}

MetaText readMetaText(const fs::path& file) {
    MetaText meta;
    meta.file = file;
    meta.text = firstBytes(file, kLongestStudyHeader);
    std::string line;
    for (int number = 1; nextLine(meta.text, meta.end, line); ++number) {
        const std::size_t equal = line.find('=');
        const bool keyed = equal != std::string::npos;
        const std::string key = keyed ? loweredText(trimmedText(line.substr(0, equal))) : "";
        meta.take(number, key, keyed ? trimmedText(line.substr(equal + 1)) : "");
        if (key != "elementdatafile") continue;
        const char* missing = meta.axes == 0                      ? "NDims"
                              : meta.size.empty()                 ? "DimSize"
                              : meta.value("elementtype").empty() ? "ElementType"
                                                                  : nullptr;
        if (missing)
            throw Error(file.string(), "", fmt::format("its header has no {}", missing),
                        "the header is damaged: get it again");
        return meta;
    }
    throw Error(file.string(), "", "expected a MetaImage header, which ends with ElementDataFile",
                "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
}

SampleType metaType(const MetaText& meta) {
    static const std::map<std::string, SampleType> kTypes = {
        {"met_char", SampleType::Int8},         {"met_ascii_char", SampleType::Int8},
        {"met_uchar", SampleType::UInt8},       {"met_short", SampleType::Int16},
        {"met_ushort", SampleType::UInt16},     {"met_int", SampleType::Int32},
        {"met_uint", SampleType::UInt32},       {"met_long", SampleType::Int32},  // MetaIO's are of 32 bits
        {"met_ulong", SampleType::UInt32},      {"met_long_long", SampleType::Int64},
        {"met_ulong_long", SampleType::UInt64}, {"met_float", SampleType::Float32},
        {"met_double", SampleType::Float64}};
    const std::string name = meta.value("elementtype");
    const auto at = kTypes.find(loweredText(name));
    if (at == kTypes.end())
        meta.refuse(0, fmt::format("expected an ElementType of 8 to 64 bits, as MET_SHORT, found {}",
                                   shortText(name)));
    const std::string channels = meta.value("elementnumberofchannels");
    if (!channels.empty() && numberOf(channels, Plus::Allowed).value_or(0) != 1)
        throw Error(meta.file.string(), "", "expected one number a voxel, found " + shortText(channels),
                    "save one component of it alone");
    return at->second;
}

// "LOCAL", "LIST [dimensions]", "pattern [first [last [step]]]", or a name that may hold blanks.
void takeMetaFiles(const MetaText& meta, const VolumeHeader& header, SamplePlace& place) {
    const std::string value = meta.value("elementdatafile");
    const auto words = ownWordsOf(value);
    if (words.empty())
        throw Error(meta.file.string(), "", "names no data file", "the header is damaged: get it again");
    if (loweredText(words[0]) == "local") {
        place.files = {meta.file};
        place.offset = meta.end;
        return;
    }
    if (words[0] == "LIST") {
        place.files = listedFiles(meta.file, meta.text, meta.end);
        return;
    }
    std::int64_t numbers[] = {1, static_cast<std::int64_t>(header.size[2]), 1};
    bool pattern = words[0].find('%') != std::string::npos && words.size() <= 4;
    for (std::size_t n = 1; pattern && n < words.size(); ++n) {
        const auto number = wholeOf<std::int64_t>(words[n], Plus::Allowed);
        pattern = number.has_value();
        if (pattern) numbers[n - 1] = *number;
    }
    place.files = pattern ? numberedFiles(meta.file, words[0], numbers[0], numbers[1], numbers[2])
                          : std::vector<fs::path>{besideHeader(meta.file, value)};
}

void takeMetaPlace(const MetaText& meta, VolumeHeader& header) {
    SamplePlace& place = header.place;
    takeMetaFiles(meta, header, place);
    const bool text = meta.values.contains("binarydata") && !meta.isTrue("binarydata");
    const bool big = meta.isTrue("binarydatabyteordermsb") || meta.isTrue("elementbyteordermsb");
    if (meta.isTrue("compresseddata"))
        place.encoding = SampleEncoding::Deflate;
    else if (text)
        place.encoding = SampleEncoding::Text;
    place.turned = big != (std::endian::native == std::endian::big);
    const std::string skip = meta.value("headersize");
    if (skip.empty()) return;
    const auto bytes = wholeOf<std::int64_t>(skip, Plus::Allowed);
    if (!bytes || *bytes < -1 || *bytes > 1'000'000'000'000)
        meta.refuse(0, "expected a HeaderSize of bytes, or -1, found " + shortText(skip));
    place.atEnd = *bytes < 0 && place.encoding == SampleEncoding::Raw;
    if (*bytes > 0) place.offset = static_cast<std::uint64_t>(*bytes);  // from the file's beginning
}

void takeMetaFrame(const MetaText& meta, VolumeHeader& header) {
    double unit = 1;
    const std::string name = meta.value("distanceunits");
    if (const auto known = millimetresOf(name)) unit = *known;
    if (!name.empty() && name != "?" && unit != 1)
        header.notes.push_back("lengths of the header are in " + shortText(name));
    if (meta.spacing.empty()) header.notes.push_back("the header has no spacing: 1 mm is taken");
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1;
        for (int c = 0; c < 3 && !meta.directions.empty(); ++c)
            direction[c] = meta.directions[axis * meta.axes + c];
        const double length = glm::length(direction);
        if (!(length > 0)) meta.refuse(0, fmt::format("axis {} has no direction", axis + 1));
        header.steps[axis] = direction / length * (meta.spacing.empty() ? 1 : meta.spacing[axis]) * unit;
        if (!meta.origin.empty()) header.origin[axis] = meta.origin[axis] * unit;
    }
}

}  // namespace

VolumeHeader readMetaHeader(const fs::path& file) {
    const MetaText meta = readMetaText(file);
    VolumeHeader header;
    header.format = "MetaImage";
    header.description = meta.value("comment");
    header.headers = {file};
    std::vector<std::uint64_t> size;
    for (const double n : meta.size) size.push_back(static_cast<std::uint64_t>(n));
    header.size = threeSizes(file, size);
    header.type = metaType(meta);
    takeMetaFrame(meta, header);
    header.directed = !meta.directions.empty();
    takeMetaPlace(meta, header);
    return header;
}

}  // namespace stereonav
