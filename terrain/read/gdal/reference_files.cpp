#include "terrain/read/gdal/reference_files.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr std::uintmax_t kLargestMetadata = 100 << 20;  // bytes; larger ones are refused

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool isPath(std::string_view name) {
    return name.find_first_of("/\\~") != std::string_view::npos;
}

// The first path among names that are divided by commas.
std::string firstPath(std::string_view names) {
    while (!names.empty()) {
        const std::size_t comma = std::min(names.find(','), names.size());
        if (isPath(names.substr(0, comma))) return std::string(names.substr(0, comma));
        names.remove_prefix(std::min(comma + 1, names.size()));
    }
    return "";
}

// A PROJ string's value ends at white space, at the quotation mark of the WKT that it stands in, or at a
// bracket.
std::string pathAfterEquals(std::string_view rest) {
    const std::size_t start = rest.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || rest[start] != '=') return "";
    rest.remove_prefix(start + 1);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n\"'"), rest.size()));
    return firstPath(rest.substr(0, rest.find_first_of(" \t\r\n\"'[]")));
}

// WKT has the name as the quoted text that follows: EXTENSION["PROJ4_GRIDS","<name>"],
// PARAMETERFILE["<what>","<name>"].
std::string pathInQuotes(std::string_view rest, int quoted) {
    for (; quoted > 0; --quoted) {
        const std::size_t from = rest.find('"');
        if (from == std::string_view::npos) return "";
        rest.remove_prefix(from + 1);
        const std::size_t to = std::min(rest.find('"'), rest.size());
        if (quoted == 1) return firstPath(rest.substr(0, to));
        rest.remove_prefix(std::min(to + 1, rest.size()));
    }
    return "";
}

// What may take a file's name: keys of PROJ strings and keywords of WKT.
struct FileKey {
    std::string_view key;
    int quoted;  // the name is this quoted text after the key; 0: it follows "="
};
constexpr FileKey kFileKeys[] = {{"grids", 0},   {"init", 0},          {"file", 0},         {"model", 0},
                                 {"catalog", 0}, {"proj4_grids\"", 1}, {"parameterfile", 2}};

[[noreturn]] void refusePath(const std::string& file, const std::string& path) {
    throw Error(file, "reference system", "names the file " + path,
                "take the path out: grids are found by their bare names where PROJ keeps them");
}

// Elements and attributes whose text is a definition or a name of one, as GDAL calls them.
bool holdsReference(const std::string& called) {
    return (called.size() >= 3 && EQUAL(called.c_str() + called.size() - 3, "SRS")) ||
           EQUAL(called.c_str(), "Projection");
}

// Returns whether an element or option so called may hold an operation of PROJ: what a transformer of a
// virtual raster is given.
bool holdsOperation(const std::string& called) {
    return EQUAL(called.c_str(), "CoordinateOperation") || EQUAL(called.c_str(), "Option");
}

// Returns whether a text is a definition and no name of one: WKT, JSON, a PROJ string.
bool isDefinition(std::string_view text) {
    return text.find_first_of("[({+=") != std::string_view::npos;
}

void checkNodes(const CPLXMLNode* node, const std::string& file, int nested) {
    constexpr int kDeepest = 64;  // elements within each other; deeper ones hold nothing that GDAL reads
    for (; node && nested < kDeepest; node = node->psNext) {
        if (node->eType != CXT_Element && node->eType != CXT_Attribute) continue;
        checkReferenceText(*node, file);
        checkNodes(node->psChild, file, nested + 1);
    }
}

// Refuses paths in the strings of each member "crs"; the rest of the text is passed over without being kept.
class JsonReferences final : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit JsonReferences(std::string file) : mFile(std::move(file)) {}

    bool key(std::string& name) override {
        if (mWithin == 0 && name == "crs") mNext = true;
        return true;
    }
    bool string(std::string& text) override {
        std::error_code code;
        if (mNext || mWithin > 0) {
            if (const std::string path = pathInReference(text); !path.empty()) refusePath(mFile, path);
            if (!isDefinition(text) && isPath(text) && std::filesystem::exists(text, code))
                refusePath(mFile, text);
        }
        return passed();
    }
    bool start_object(std::size_t) override { return opened(); }
    bool end_object() override { return closed(); }
    bool start_array(std::size_t) override { return opened(); }
    bool end_array() override { return closed(); }
    bool null() override { return passed(); }
    bool boolean(bool) override { return passed(); }
    bool number_integer(std::int64_t) override { return passed(); }
    bool number_unsigned(std::uint64_t) override { return passed(); }
    bool number_float(double, const std::string&) override { return passed(); }
    bool binary(nlohmann::json::binary_t&) override { return passed(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
        return false;
    }

private:
    bool passed() {
        mNext = false;
        return true;
    }
    bool opened() {
        if (mNext || mWithin > 0) ++mWithin;
        return passed();
    }
    bool closed() {
        if (mWithin > 0) --mWithin;
        return true;
    }

    std::string mFile;
    bool mNext = false;       // whether the value to come is that of a member "crs"
    std::size_t mWithin = 0;  // objects and arrays that are open, from that value on
};

// Returns false where there is nothing to read. Throws Error where there is too much. Names as GDAL has them:
// a file may lie within a packed one.
bool isReadable(const std::string& file) {
    VSIStatBufL found;
    if (VSIStatExL(file.c_str(), &found, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG | VSI_STAT_SIZE_FLAG) !=
            0 ||
        !VSI_ISREG(found.st_mode))
        return false;
    if (static_cast<std::uintmax_t>(found.st_size) > kLargestMetadata)
        throw Error(file, "", "expected at most 100 MB of text", "take it away");
    return true;
}

void checkMetadata(const std::string& file) {
    if (!isReadable(file)) return;
    struct Destroy {
        void operator()(CPLXMLNode* root) const { CPLDestroyXMLNode(root); }
    };
    const CPLErrorStateBackuper state;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);  // GDAL tells of damaged XML itself
    const std::unique_ptr<CPLXMLNode, Destroy> root(CPLParseXMLFile(file.c_str()));
    checkNodes(root.get(), file, 0);
}

// Checks the definition that follows `key`; "": the whole text.
void checkText(const std::string& file, const char* key) {
    constexpr std::size_t kMost = 1 << 20;  // bytes; drivers read less of it
    if (!isReadable(file)) return;
    const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> in(VSIFOpenL(file.c_str(), "rb"), VSIFCloseL);
    if (!in) return;
    std::string text(kMost, '\0');
    text.resize(VSIFReadL(text.data(), 1, kMost, in.get()));
    const std::size_t at = text.find(key);
    if (at == std::string::npos) return;
    if (const std::string path = pathInReference(std::string_view(text).substr(at)); !path.empty())
        refusePath(file, path);
}

// GDAL reads on where the text is not quite JSON. Returns whether a member "crs" may name a path: a letter is
// written by its number, or what may be a path stands within 1 KB behind "crs".
bool mayNamePath(const std::filesystem::path& file) {
    constexpr std::size_t kNear = 1024, kChunk = 1 << 20;  // bytes
    std::ifstream in(file, std::ios::binary);
    std::string text;
    while (in) {
        if (text.size() > kNear) text.erase(0, text.size() - kNear);  // what stands at the seam is seen whole
        const std::size_t kept = text.size();
        text.resize(kept + kChunk);
        in.read(text.data() + kept, static_cast<std::streamsize>(kChunk));
        text.resize(kept + static_cast<std::size_t>(in.gcount()));
        for (const char* letter : {"\\u004", "\\u005", "\\u006", "\\u007"})
            if (text.find(letter) != std::string::npos) return true;
        for (std::size_t at = text.find("crs"); at != std::string::npos; at = text.find("crs", at + 1))
            if (isPath(std::string_view(text).substr(at, kNear))) return true;
    }
    return false;
}

}  // namespace

std::string pathInReference(std::string_view definition) {
    std::string text(definition);
    std::transform(text.begin(), text.end(), text.begin(), lower);
    for (const auto& [key, quoted] : kFileKeys)
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
            const std::string_view rest = definition.substr(at + key.size());
            if (std::string path = quoted == 0 ? pathAfterEquals(rest) : pathInQuotes(rest, quoted);
                !path.empty())
                return path;
        }
    return "";
}

void checkReference(const OGRSpatialReference* system, const std::string& file) {
    if (!system) return;
    for (const char* format : {"FORMAT=WKT1_GDAL", "FORMAT=WKT2_2019"}) {
        const char* const options[] = {format, nullptr};
        char* text = nullptr;
        const CPLErrorStateBackuper state;
        const CPLErrorHandlerPusher quiet(
            CPLQuietErrorHandler);  // what one format can not say the other does
        system->exportToWkt(&text, options);
        const std::string path = pathInReference(text ? text : "");
        CPLFree(text);
        if (!path.empty()) refusePath(file, path);
    }
}

void checkReferenceText(const CPLXMLNode& node, const std::string& file) {
    const std::string called = node.pszValue;
    if (!holdsReference(called) && !holdsOperation(called)) return;
    const std::string_view text = CPLGetXMLValue(&node, nullptr, "");
    if (const std::string path = pathInReference(text); !path.empty()) refusePath(file, path);
    std::error_code code;
    if (holdsReference(called) && !isDefinition(text) && std::filesystem::exists(text, code))
        refusePath(file, std::string(text));
}

void checkReferencesBeside(const std::string& file) {
    checkMetadata(file + ".aux.xml");
    for (const char* extension : {"prj", "PRJ"}) checkText(CPLResetExtension(file.c_str(), extension), "");
    for (const std::string& header : {std::string(CPLResetExtension(file.c_str(), "hdr")), file + ".hdr"})
        checkText(header, "coordinate system string");
}

void checkJsonReferences(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if ((in >> std::ws).peek() == '<') return;                    // GPX
    in.ignore(std::numeric_limits<std::streamsize>::max(), '{');  // GDAL passes over what goes before
    if (!in) return;
    in.unget();
    JsonReferences references(file.string());
    const bool valid =
        nlohmann::json::sax_parse(in, &references, nlohmann::json::input_format_t::json, false, true);
    if (!valid && mayNamePath(file))
        throw Error(file.string(), "",
                    "is no valid JSON, and names a reference system that can not be checked",
                    "write it again");
}

}  // namespace stereonav
