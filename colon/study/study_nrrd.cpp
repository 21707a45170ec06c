// NRRD headers, attached or detached: teem.sourceforge.net/nrrd/format.html.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "colon/study/study_header.h"
#include "colon/study/study_text.h"
#include "engine/base/regular_file.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostAxes = 16;  // axes that teem knows

struct NrrdField {
    std::string value;
    int line = 0;
};

struct NrrdText {
    fs::path file;
    std::map<std::string, NrrdField> fields;  // names without blanks, in small letters
    HeaderFields keyed;                       // "key:=value"
    std::string comment;                      // the key "comment", or "content"
    std::string text;                         // the file's beginning
    std::size_t end = 0;                      // end of the header in `text`
    bool whole = false;                       // an empty line ends it

    const std::string& value(const std::string& name) const {
        static const std::string kNone;
        const auto at = fields.find(name);
        return at == fields.end() ? kNone : at->second.value;
    }
    [[noreturn]] void refuse(const std::string& name, const std::string& problem) const {
        const auto at = fields.find(name);
        throw Error(file.string(), at == fields.end() ? "" : std::to_string(at->second.line),
                    "expected a NRRD volume: " + problem, "correct it in the header");
    }
};

NrrdText readNrrdText(const fs::path& file) {
    NrrdText nrrd;
    nrrd.file = file;
    nrrd.text = firstBytes(file, kLongestStudyHeader);
    if (!nrrd.text.starts_with("NRRD000"))
        throw Error(file.string(), "", "expected a NRRD file, which begins with NRRD000",
                    "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
    std::string line;
    for (int number = 1; nextLine(nrrd.text, nrrd.end, line); ++number) {
        if (trimmedText(line).empty()) {
            nrrd.whole = true;
            break;
        }
        if (line[0] == '#') continue;
        const std::size_t keyed = line.find(":=");
        const std::size_t colon = line.find(':');
        if (keyed != std::string::npos && keyed == colon) {
            nrrd.keyed.emplace_back(line.substr(0, keyed), line.substr(keyed + 2));
            if (loweredText(line.substr(0, keyed)) == "comment") nrrd.comment = line.substr(keyed + 2);
            continue;
        }
        if (colon == std::string::npos) continue;
        std::string name;
        for (const char c : loweredText(line.substr(0, colon)))
            if (c != ' ') name += c;
        const std::string raw = line.substr(colon + 1);
        const bool quoted = name == "spaceunits" || name == "units" || name == "kinds";
        nrrd.fields[name] = {quoted ? raw : trimmedText(raw), number};
        if (name == "datafile" && trimmedText(raw).starts_with("LIST")) break;  // the names follow
    }
    if (nrrd.comment.empty()) nrrd.comment = nrrd.value("content");
    return nrrd;
}

SampleType nrrdType(const NrrdText& nrrd) {
    static const std::map<std::string, SampleType> kTypes = {{"signed char", SampleType::Int8},
                                                             {"int8", SampleType::Int8},
                                                             {"int8_t", SampleType::Int8},
                                                             {"char", SampleType::Int8},
                                                             {"uchar", SampleType::UInt8},
                                                             {"unsigned char", SampleType::UInt8},
                                                             {"uint8", SampleType::UInt8},
                                                             {"uint8_t", SampleType::UInt8},
                                                             {"short", SampleType::Int16},
                                                             {"short int", SampleType::Int16},
                                                             {"signed short", SampleType::Int16},
                                                             {"signed short int", SampleType::Int16},
                                                             {"int16", SampleType::Int16},
                                                             {"int16_t", SampleType::Int16},
                                                             {"ushort", SampleType::UInt16},
                                                             {"unsigned short", SampleType::UInt16},
                                                             {"unsigned short int", SampleType::UInt16},
                                                             {"uint16", SampleType::UInt16},
                                                             {"uint16_t", SampleType::UInt16},
                                                             {"int", SampleType::Int32},
                                                             {"signed int", SampleType::Int32},
                                                             {"int32", SampleType::Int32},
                                                             {"int32_t", SampleType::Int32},
                                                             {"uint", SampleType::UInt32},
                                                             {"unsigned int", SampleType::UInt32},
                                                             {"uint32", SampleType::UInt32},
                                                             {"uint32_t", SampleType::UInt32},
                                                             {"longlong", SampleType::Int64},
                                                             {"long long", SampleType::Int64},
                                                             {"long long int", SampleType::Int64},
                                                             {"signed long long", SampleType::Int64},
                                                             {"signed long long int", SampleType::Int64},
                                                             {"int64", SampleType::Int64},
                                                             {"int64_t", SampleType::Int64},
                                                             {"ulonglong", SampleType::UInt64},
                                                             {"unsigned long long", SampleType::UInt64},
                                                             {"unsigned long long int", SampleType::UInt64},
                                                             {"uint64", SampleType::UInt64},
                                                             {"uint64_t", SampleType::UInt64},
                                                             {"float", SampleType::Float32},
                                                             {"double", SampleType::Float64}};
    const auto at = kTypes.find(loweredText(nrrd.value("type")));
    if (at == kTypes.end())
        nrrd.refuse("type",
                    fmt::format("its type should be one of 8 to 64 bits (as short or float), found \"{}\"",
                                shortText(nrrd.value("type"))));
    return at->second;
}

// "(1,0,0) none (0,1,0)": three numbers an axis, none where the axis is not of space.
using NrrdVectors = std::vector<std::optional<glm::dvec3>>;

NrrdVectors vectorsOf(const NrrdText& nrrd, const std::string& name) {
    NrrdVectors vectors;
    const std::string& text = nrrd.value(name);
    for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != std::string::npos;) {
        if (loweredText(text.substr(at, 4)) == "none") {
            vectors.emplace_back();
            at += 4;
            continue;
        }
        const std::size_t close = text.find(')', at);
        std::string inside = text[at] == '(' && close != std::string::npos
                                 ? text.substr(at + 1, close - at - 1)
                                 : std::string("?");
        std::replace(inside.begin(), inside.end(), ',', ' ');
        const auto words = ownWordsOf(inside);
        glm::dvec3 v(0.0);
        bool good = words.size() == 3;
        for (int c = 0; good && c < 3; ++c) {
            const auto number = numberOf(words[c], Plus::Allowed);
            good = number && std::isfinite(*number);
            if (good) v[c] = *number;
        }
        if (!good)
            nrrd.refuse(name, fmt::format("expected vectors of three numbers in \"{}\", found {}",
                                          name == "spaceorigin" ? "space origin" : "space directions",
                                          shortText(text)));
        vectors.emplace_back(v);
        at = close + 1;
    }
    return vectors;
}

// One number a word; not a number where a word is none ("nan", "none").
std::vector<double> axisNumbers(const NrrdText& nrrd, const std::string& name, std::size_t axes) {
    std::vector<double> numbers(axes, std::nan(""));
    const auto words = ownWordsOf(nrrd.value(name));
    for (std::size_t n = 0; n < std::min(axes, words.size()); ++n)
        numbers[n] = numberOf(words[n], Plus::Allowed).value_or(std::nan(""));
    return numbers;
}

// "\"mm\" \"mm\" \"\"": in quotation marks, or words where there are none.
std::vector<std::string> quotedWords(const std::string& text) {
    if (text.find('"') == std::string::npos) return ownWordsOf(text);
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos;) {
        const std::size_t end = text.find('"', at + 1);
        if (end == std::string::npos) break;
        words.push_back(text.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return words;
}

std::vector<std::uint64_t> sizesOf(const NrrdText& nrrd) {
    const auto dimension = wholeOf<std::int64_t>(nrrd.value("dimension"), Plus::Allowed);
    if (!dimension || *dimension < 1 || *dimension > static_cast<std::int64_t>(kMostAxes))
        nrrd.refuse("dimension", fmt::format("expected a dimension of 1 to {}, found \"{}\"", kMostAxes,
                                             shortText(nrrd.value("dimension"))));
    const auto words = ownWordsOf(nrrd.value("sizes"));
    std::vector<std::uint64_t> sizes;
    for (const std::string& word : words) {
        const auto size = wholeOf<std::int64_t>(word, Plus::Allowed);
        if (!size || *size < 1)
            nrrd.refuse("sizes", fmt::format("expected whole sizes above 0, found {}", shortText(word)));
        sizes.push_back(static_cast<std::uint64_t>(*size));
    }
    if (sizes.size() != static_cast<std::size_t>(*dimension))
        nrrd.refuse("sizes", fmt::format("expected {} sizes, found {}", *dimension, sizes.size()));
    return sizes;
}

// Axes that hold several numbers of one voxel, by their kind or because they have no direction.
bool isComponents(const NrrdText& nrrd, std::size_t axis, const NrrdVectors& directions) {
    if (!directions.empty()) return axis >= directions.size() || !directions[axis];
    const auto kinds = quotedWords(nrrd.value("kinds"));
    if (axis >= kinds.size()) return false;
    const std::string kind = loweredText(kinds[axis]);
    for (const char* known : {"domain", "space", "time", "none", "???", "scalar", "stub"})
        if (kind == known) return false;
    return true;
}

// The axes of space among all. Of the others one may have several entries, the layers of a mask whose labels
// the header names.
std::vector<std::size_t> spaceAxes(const NrrdText& nrrd, const std::vector<std::uint64_t>& sizes,
                                   const NrrdVectors& directions, LabelLayers& layers) {
    constexpr std::uint64_t kMostLayers = 4096;
    const bool named = namesLabels(nrrd.keyed);
    std::vector<std::size_t> axes;
    std::uint64_t before = 1;  // samples, as far as they are bounded by what memory holds
    for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
        if (!isComponents(nrrd, axis, directions)) {
            axes.push_back(axis);
        } else if (sizes[axis] > 1) {
            if (!named || layers.count > 1 || sizes[axis] > kMostLayers)
                throw Error(nrrd.file.string(), "",
                            fmt::format("expected one number a voxel, found {}", sizes[axis]),
                            "save one component of it alone");
            layers = {sizes[axis], before};
        }
        before *= sizes[axis];
    }
    return axes;
}

// Signs from the header's space to LPS, and a word where it does not say how a patient lies.
glm::dvec3 toLps(const NrrdText& nrrd, bool directed, std::vector<std::string>& notes) {
    std::string space = loweredText(nrrd.value("space"));
    if (space.ends_with("-time")) space.resize(space.size() - 5);
    if (space == "ras") space = "right-anterior-superior";
    if (space == "las") space = "left-anterior-superior";
    if (space == "lps") space = "left-posterior-superior";
    if (space == "left-posterior-superior") return {1, 1, 1};
    if (space == "right-anterior-superior") return {-1, -1, 1};
    if (space == "left-anterior-superior") return {1, -1, 1};
    if (space.empty() && nrrd.value("spacedimension").empty()) return {1, 1, 1};
    const bool handed = space == "3d-right-handed" || space == "3d-left-handed";
    if (!space.empty() && !handed && space != "scanner-xyz")
        nrrd.refuse("space",
                    fmt::format("expected a space of three axes, as left-posterior-superior, found {}",
                                shortText(space)));
    const bool mirrored = directed && space == "3d-left-handed";
    notes.push_back(directed
                        ? fmt::format("its space{}{} says nothing of the patient: its axes are taken for "
                                      "the patient's (LPS){}",
                                      space.empty() ? "" : " ", space,
                                      mirrored ? ", the third turned, as it is left-handed" : "")
                        : "the header names a space but no directions: its axes are taken for the "
                          "patient's (LPS)");
    return {1, 1, mirrored ? -1 : 1};
}

// Millimetres of the header's unit along each axis of space.
glm::dvec3 unitsOf(const NrrdText& nrrd, const std::vector<std::size_t>& axes, bool directed,
                   std::vector<std::string>& notes) {
    glm::dvec3 units(1.0);
    // Space units are those of the world's axes, units those of the grid's.
    const auto words = quotedWords(nrrd.value(directed ? "spaceunits" : "units"));
    for (std::size_t n = 0; n < 3; ++n) {
        const std::size_t at = directed ? n : axes[n];
        if (at >= words.size() || words[at].empty() || words[at] == "???") continue;
        const auto unit = millimetresOf(trimmedText(words[at]));
        if (unit)
            units[static_cast<int>(n)] = *unit;
        else
            notes.push_back(fmt::format("the unit \"{}\" of its axis {} is taken for millimetres",
                                        shortText(words[at]), n + 1));
    }
    return units;
}

void takeDirected(const NrrdText& nrrd, const NrrdVectors& directions, const std::vector<std::size_t>& axes,
                  VolumeHeader& header) {
    const glm::dvec3 scale = toLps(nrrd, true, header.notes) * unitsOf(nrrd, axes, true, header.notes);
    for (int n = 0; n < 3; ++n) header.steps[n] = *directions[axes[n]] * scale;
    const auto origin = vectorsOf(nrrd, "spaceorigin");
    if (!origin.empty() && origin[0]) header.origin = *origin[0] * scale;
}

// Without directions: spacings, or the ends of the axes, along the grid's own axes.
void takeSpaced(const NrrdText& nrrd, const std::vector<std::size_t>& axes, VolumeHeader& header) {
    const std::size_t count = axes.back() + 1;
    toLps(nrrd, false, header.notes);
    const glm::dvec3 units = unitsOf(nrrd, axes, false, header.notes);
    const auto spacings = axisNumbers(nrrd, "spacings", count), least = axisNumbers(nrrd, "axismins", count),
               most = axisNumbers(nrrd, "axismaxs", count);
    auto centers =
        ownWordsOf(loweredText(nrrd.value(nrrd.fields.contains("centers") ? "centers" : "centerings")));
    centers.resize(count);
    bool known = true;
    header.steps = glm::dmat3(0.0);
    for (int n = 0; n < 3; ++n) {
        const std::size_t axis = axes[n];
        const bool node = centers[axis] == "node";
        const double cells = static_cast<double>(header.size[n]) - (node ? 1 : 0);
        double spacing = spacings[axis];
        if (std::isnan(spacing)) spacing = (most[axis] - least[axis]) / cells;
        if (!std::isnan(spacing) && !(spacing > 0 && std::isfinite(spacing)))
            nrrd.refuse("spacings",
                        fmt::format("expected a spacing above 0 along axis {}, found {:g}", n + 1, spacing));
        known &= !std::isnan(spacing);
        if (std::isnan(spacing)) spacing = 1;
        header.steps[n][n] = spacing * units[n];
        if (!std::isnan(least[axis]))
            header.origin[n] = (least[axis] + (node ? 0 : 0.5 * spacing)) * units[n];
    }
    if (!known) header.notes.push_back("the header has no spacing along some axis: 1 mm is taken");
}

std::int64_t skipOf(const NrrdText& nrrd, const std::string& name, std::int64_t least) {
    if (!nrrd.fields.contains(name)) return 0;
    const auto skip = wholeOf<std::int64_t>(nrrd.value(name), Plus::Allowed);
    if (!skip || *skip < least || *skip > 1'000'000'000'000)
        nrrd.refuse(name, fmt::format("expected a count of {} to skip, found {}",
                                      name == "lineskip" ? "lines" : "bytes", shortText(nrrd.value(name))));
    return *skip;
}

SampleEncoding encodingOf(const NrrdText& nrrd) {
    const std::string name = loweredText(nrrd.value("encoding"));
    if (name == "raw") return SampleEncoding::Raw;
    if (name == "gzip" || name == "gz") return SampleEncoding::Deflate;
    if (name == "bzip2" || name == "bz2") return SampleEncoding::Bzip2;
    if (name == "ascii" || name == "text" || name == "txt") return SampleEncoding::Text;
    if (name == "hex") return SampleEncoding::Hex;
    nrrd.refuse("encoding", fmt::format("expected an encoding (raw, gzip, bzip2, text, hex), found \"{}\"",
                                        shortText(nrrd.value("encoding"))));
}

// "LIST", "pattern first last step [dimensions]", or a name that may hold blanks.
std::vector<fs::path> nrrdFiles(const NrrdText& nrrd) {
    const std::string& value = nrrd.value("datafile");
    const auto words = ownWordsOf(value);
    if (words[0] == "LIST") return listedFiles(nrrd.file, nrrd.text, nrrd.end);
    if (words.size() >= 4 && words[0].find('%') != std::string::npos) {
        const auto first = wholeOf<std::int64_t>(words[1], Plus::Allowed),
                   last = wholeOf<std::int64_t>(words[2], Plus::Allowed),
                   step = wholeOf<std::int64_t>(words[3], Plus::Allowed);
        if (first && last && step) return numberedFiles(nrrd.file, words[0], *first, *last, *step);
    }
    return {besideHeader(nrrd.file, value)};
}

void takeNrrdPlace(const NrrdText& nrrd, VolumeHeader& header) {
    SamplePlace& place = header.place;
    place.encoding = encodingOf(nrrd);
    const bool detached = !nrrd.value("datafile").empty();
    if (detached)
        place.files = nrrdFiles(nrrd);
    else if (nrrd.whole)
        place.files = {nrrd.file};
    else
        nrrd.refuse("", "the header does not end with an empty line, nor names a data file");
    place.offset = detached ? 0 : nrrd.end;
    place.lines = static_cast<std::uint64_t>(skipOf(nrrd, "lineskip", 0));
    const std::int64_t skip = skipOf(nrrd, "byteskip", -1);
    place.atEnd = skip < 0;
    if (place.atEnd && place.encoding != SampleEncoding::Raw)
        nrrd.refuse("byteskip", "a byte skip of -1 goes with raw samples only");
    place.skip = static_cast<std::uint64_t>(std::max<std::int64_t>(skip, 0));
    const std::string endian = loweredText(nrrd.value("endian"));
    const bool bytes = place.encoding != SampleEncoding::Text && bytesOf(header.type) > 1;
    if (bytes && endian != "little" && endian != "big")
        nrrd.refuse("endian", fmt::format("expected endian: little or big, found \"{}\"", shortText(endian)));
    place.turned = bytes && (endian == "little") != (std::endian::native == std::endian::little);
}

}  // namespace

VolumeHeader readNrrdHeader(const fs::path& file) {
    const NrrdText nrrd = readNrrdText(file);
    VolumeHeader header;
    header.format = "NRRD";
    header.description = nrrd.comment;
    header.headers = {file};
    header.type = nrrdType(nrrd);
    const auto sizes = sizesOf(nrrd);
    const NrrdVectors directions = vectorsOf(nrrd, "spacedirections");
    if (!directions.empty() && directions.size() != sizes.size())
        nrrd.refuse("spacedirections",
                    fmt::format("expected {} space directions, found {}", sizes.size(), directions.size()));
    std::vector<std::size_t> axes = spaceAxes(nrrd, sizes, directions, header.labels.layers);
    header.labels.named = namedLabelsOf(file.string(), nrrd.keyed, header.labels.layers.count);
    std::vector<std::uint64_t> extents;
    extents.reserve(axes.size());
    for (const std::size_t axis : axes) extents.push_back(sizes[axis]);
    header.size = threeSizes(file, extents);
    axes.resize(3);
    header.directed = !directions.empty();
    if (directions.empty())
        takeSpaced(nrrd, axes, header);
    else
        takeDirected(nrrd, directions, axes, header);
    takeNrrdPlace(nrrd, header);
    return header;
}

}  // namespace stereonav
