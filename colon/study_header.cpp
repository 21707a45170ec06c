// Where the samples of a NRRD, MetaImage or NIfTI file are, from the header's text: a first look that needs
// no decoding. Formats: teem.sourceforge.net/nrrd/format.html, itk.org MetaIO, nifti.nimh.nih.gov.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>

#include "colon/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// deflate never makes more than 1032 bytes of one (zlib's technical notes).
constexpr std::uint64_t kMostInflation = 1032;
constexpr std::size_t kLongestHeader = 1 << 20;
constexpr std::uint64_t kNiftiOffset = 352;  // of the samples, at least
constexpr int kMostFiles = 100000;

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r\"");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::string lowered(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string beginning(const fs::path& file, std::size_t bytes) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(file.string(), "", "can not be opened", "check the name and its permissions");
    std::string text(bytes, '\0');
    in.read(text.data(), static_cast<std::streamsize>(bytes));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

// One line of text from `at` on, which moves behind it; false at the end.
bool nextLine(const std::string& text, std::size_t& at, std::string& line) {
    if (at >= text.size()) return false;
    const std::size_t end = text.find('\n', at);
    line = text.substr(at, end == std::string::npos ? end : end - at);
    at = end == std::string::npos ? text.size() : end + 1;
    return true;
}

fs::path beside(const fs::path& header, const std::string& name) {
    const fs::path path(name);
    return path.is_absolute() ? path : header.parent_path() / path;
}

std::string numbered(const std::string& pattern, int n) {
    const std::size_t percent = pattern.find('%');
    const std::size_t d = percent == std::string::npos ? percent : pattern.find('d', percent);
    if (d == std::string::npos) return pattern;
    const std::string digits = pattern.substr(percent + 1, d - percent - 1);
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 2) return pattern;
    const int width = digits.empty() ? 0 : std::stoi(digits);
    const std::string number = !digits.empty() && digits[0] == '0' ? fmt::format("{:0{}}", n, width)
                                                                   : fmt::format("{:{}}", n, width);
    return pattern.substr(0, percent) + number + pattern.substr(d + 1);
}

// "slice.%03d.raw 1 93 1", as NRRD and MetaImage both write it; false when it is not that.
bool numberedFiles(const fs::path& header, const std::string& text, std::vector<fs::path>& files) {
    char pattern[512];
    int first = 0, last = 0, step = 1;
    if (std::sscanf(text.c_str(), "%511s %d %d %d", pattern, &first, &last, &step) < 3) return false;
    if (!std::strchr(pattern, '%') || step == 0) return false;
    for (long n = first; step > 0 ? n <= last : n >= last; n += step) {
        if (files.size() >= kMostFiles) break;
        files.push_back(beside(header, numbered(pattern, static_cast<int>(n))));
    }
    return true;
}

// The names listed on the lines from `at` on, one a line.
void listedFiles(const fs::path& header, const std::string& text, std::size_t at, DataPlace& place) {
    std::string line;
    while (nextLine(text, at, line) && place.files.size() < kMostFiles)
        if (!trimmed(line).empty()) place.files.push_back(beside(header, trimmed(line)));
}

void nameDataFiles(const fs::path& header, const std::string& value, const std::string& text, std::size_t at,
                   DataPlace& place) {
    if (value == "LOCAL" || value == "local") {
        place.files.push_back(header);
        place.offset = at;
    } else if (value.rfind("LIST", 0) == 0) {
        listedFiles(header, text, at, place);
    } else if (!numberedFiles(header, value, place.files)) {
        place.files.push_back(beside(header, value));
    }
}

DataPlace findNrrdData(const fs::path& file) {
    const std::string text = beginning(file, kLongestHeader);
    DataPlace place;
    if (text.rfind("NRRD000", 0) != 0)
        throw Error(file.string(), "", "expected a NRRD file, which begins with NRRD000",
                    "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
    std::string line, dataFile = "LOCAL";
    std::size_t at = 0;
    while (nextLine(text, at, line)) {
        if (trimmed(line).empty()) break;
        const std::size_t colon = line.find(": ");
        if (line[0] == '#' || colon == std::string::npos) continue;
        const std::string key = lowered(trimmed(line.substr(0, colon)));
        const std::string value = trimmed(line.substr(colon + 2));
        if (key == "encoding") {
            place.compressed = value == "gzip" || value == "gz" || value == "bzip2" || value == "bz2";
            place.counted = place.compressed || value == "raw";
        }
        if (key == "line skip" || key == "lineskip" || key == "byte skip" || key == "byteskip")
            place.counted &= value == "0";
        if (key != "data file" && key != "datafile") continue;
        dataFile = value;
        if (value.rfind("LIST", 0) == 0) break;
    }
    nameDataFiles(file, dataFile, text, at, place);
    return place;
}

DataPlace findMetaData(const fs::path& file) {
    const std::string text = beginning(file, kLongestHeader);
    DataPlace place;
    MetaHeaderCheck check(file);
    std::string line;
    std::size_t at = 0;
    while (nextLine(text, at, line)) {
        const std::size_t equal = line.find('=');
        const bool keyed = equal != std::string::npos;
        const std::string key = keyed ? lowered(trimmed(line.substr(0, equal))) : "";
        const std::string value = keyed ? trimmed(line.substr(equal + 1)) : "";
        check.take(key, value);
        if (key == "compresseddata") place.compressed = lowered(value) == "true";
        if (key == "binarydata" && lowered(value) == "false") place.counted = false;
        if (key == "headersize" && value != "0") place.counted = false;
        if (key != "elementdatafile") continue;
        check.finish();
        nameDataFiles(file, value, text, at, place);
        place.countStream = place.compressed;
        return place;
    }
    throw Error(file.string(), "", "expected a MetaImage header, which ends with ElementDataFile",
                "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
}

// The first bytes of a file, inflated where it is compressed.
std::string plainBeginning(const fs::path& file, std::size_t bytes) {
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
    std::string text(bytes, '\0');
    const int count = in ? gzread(in.get(), text.data(), static_cast<unsigned>(bytes)) : 0;
    text.resize(static_cast<std::size_t>(std::max(count, 0)));
    return text;
}

DataPlace findNiftiData(const fs::path& file) {
    DataPlace place;
    place.files = {file};
    const std::string head = beginning(file, 2);
    place.compressed = head.size() == 2 && head[0] == '\x1f' && head[1] == '\x8b';
    place.offset = place.compressed ? 0 : kNiftiOffset;
    place.countStream = place.compressed;
    place.headerInside = place.compressed ? kNiftiOffset : 0;
    checkNiftiHeader(file, plainBeginning(file, 348));
    return place;
}

// Text of data files by their full paths, for a header that lies elsewhere.
std::string dataFileLines(const fs::path& file, const std::string& value, const std::string& rest) {
    if (value.rfind("LIST", 0) != 0)
        return "data file: " + fs::absolute(beside(file, value)).string() + "\n\n";
    std::string text = "data file: " + value + "\n", line;
    std::size_t at = 0;
    while (nextLine(rest, at, line))
        if (!trimmed(line).empty()) text += fs::absolute(beside(file, trimmed(line))).string() + "\n";
    return text;
}

std::uint64_t sizeOf(const fs::path& header, const fs::path& file) {
    std::error_code code;
    const auto bytes = fs::file_size(file, code);
    if (code)
        throw Error(header.string(), "", "its data file " + file.string() + " can not be opened",
                    "put it beside the header under that name");
    return bytes;
}

}  // namespace

std::string nrrdWithoutSpace(const fs::path& file) {
    const std::string text = beginning(file, kLongestHeader);
    std::string kept, line, dataFile;
    std::size_t at = 0;
    int lines = 0;
    bool space = false, spacings = false;
    while (nextLine(text, at, line)) {
        ++lines;
        if (trimmed(line).empty()) break;
        const std::size_t colon = line.find(": ");
        const std::string key =
            line[0] == '#' || colon == std::string::npos ? "" : lowered(trimmed(line.substr(0, colon)));
        if (key == "space directions") return "";
        spacings |= key == "spacings";
        space |= key == "space";
        if (key == "space" || key == "space origin" || key == "space units") continue;
        if (key == "data file" || key == "datafile")
            dataFile = dataFileLines(file, trimmed(line.substr(colon + 2)), text.substr(at));
        else
            kept += trimmed(line) + "\n";
    }
    if (!space || !spacings) return "";
    if (dataFile.empty())
        dataFile = fmt::format("line skip: {}\ndata file: {}\n\n", lines, fs::absolute(file).string());
    return kept + dataFile;
}

DataPlace findData(const fs::path& file) {
    const std::string name = lowered(file.filename().string());
    if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return findNrrdData(file);
    if (name.ends_with(".mha") || name.ends_with(".mhd")) return findMetaData(file);
    return findNiftiData(file);
}

// A gzip file ends with the count of its bytes, modulo 2^32 (RFC 1952): where that is right the stream is
// whole, else it is counted.
static void checkStream(const fs::path& file, const DataPlace& place, std::uint64_t expected) {
    const std::uint64_t whole = expected + place.headerInside;
    std::ifstream in(place.files[0], std::ios::binary);
    std::uint32_t stated = 0;
    in.seekg(-4, std::ios::end);
    in.read(reinterpret_cast<char*>(&stated), 4);
    if (place.headerInside > 0 && in && stated == static_cast<std::uint32_t>(whole) &&
        fs::file_size(file) >= whole / kMostInflation)
        return;
    const std::uint64_t found = inflatedBytes(place.files[0], place.offset, whole);
    if (found < whole)
        throw Error(file.string(), "",
                    fmt::format("cut off: the header says {} bytes of samples, found {}", expected,
                                found - std::min(found, place.headerInside)),
                    "copy the file again");
}

void checkBytes(const fs::path& file, const DataPlace& place, std::uint64_t expected) {
    if (place.files.empty())
        throw Error(file.string(), "", "names no data file", "the header is damaged: get it again");
    std::uint64_t found = 0;
    for (const fs::path& data : place.files) {
        const std::uint64_t bytes = sizeOf(file, data);
        found += bytes - std::min(bytes, place.offset);
    }
    if (!place.counted) return;
    if (place.countStream && place.files.size() == 1) return checkStream(file, place, expected);
    const bool enough = place.compressed ? found >= expected / kMostInflation : found >= expected;
    if (!enough)
        throw Error(file.string(), "",
                    fmt::format("cut off: the header says {} bytes of samples, found {}{}", expected, found,
                                place.compressed ? " compressed ones" : ""),
                    "copy the file again");
}

std::uint64_t inflatedBytes(const fs::path& file, std::uint64_t offset, std::uint64_t limit) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(offset));
    z_stream stream{};
    if (inflateInit2(&stream, 32 + MAX_WBITS) != Z_OK) return 0;  // 32: gzip or zlib, as the file has it
    const std::unique_ptr<z_stream, void (*)(z_stream*)> end(&stream, [](z_stream* s) { inflateEnd(s); });
    std::vector<unsigned char> input(1 << 18), output(1 << 20);
    std::uint64_t count = 0;
    int state = Z_OK;
    while (state == Z_OK && count < limit && in) {
        in.read(reinterpret_cast<char*>(input.data()), static_cast<std::streamsize>(input.size()));
        stream.next_in = input.data();
        stream.avail_in = static_cast<uInt>(in.gcount());
        while (state == Z_OK && stream.avail_in > 0) {
            stream.next_out = output.data();
            stream.avail_out = static_cast<uInt>(output.size());
            state = inflate(&stream, Z_NO_FLUSH);
            count += output.size() - stream.avail_out;
        }
    }
    return count;
}

}  // namespace stereonav
