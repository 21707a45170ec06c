#include "colon/study/study_text.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/named_file.h"
#include "engine/text/number.h"
#include "engine/text/printable.h"
#include "engine/text/utf8.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100000;
constexpr std::size_t kLongestFound = 60;  // bytes of the file that a message repeats

[[noreturn]] void refuseTooMany(const fs::path& header) {
    throw Error(header.string(), "", fmt::format("names more than {} data files", kMostFiles),
                "correct it in the header");
}

}  // namespace

std::string trimmedText(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r\"");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::string loweredText(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string shortText(const std::string& text) {
    const std::string found = printable(firstBytes(std::string_view(text), kLongestFound));
    return text.size() > kLongestFound ? found + fmt::format("... ({} characters)", text.size()) : found;
}

bool nextLine(const std::string& text, std::size_t& at, std::string& line) {
    if (at >= text.size()) return false;
    const std::size_t end = text.find('\n', at);
    line = text.substr(at, end == std::string::npos ? end : end - at);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at = end == std::string::npos ? text.size() : end + 1;
    return true;
}

std::vector<double> numbersIn(const std::string& text) {
    std::vector<double> numbers;
    std::string_view rest = text;
    while (true) {
        rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
        const std::optional<double> number = takeNumber(rest, Plus::Allowed);
        if (!number) return numbers;
        numbers.push_back(*number);
    }
}

fs::path besideHeader(const fs::path& header, const std::string& name) {
    if (const auto place = fileNamedBy(header, name)) return *place;
    throw Error(header.string(), "",
                "names the data file \"" + shortText(name) + "\", which is not in its own folder or below",
                "put both into one folder, and name it without a path");
}

std::string numberedName(const std::string& pattern, std::int64_t n) {
    const std::size_t percent = pattern.find('%');
    const std::size_t end = percent == std::string::npos ? percent : pattern.find_first_of("diu", percent);
    if (end == std::string::npos) return pattern;
    const std::string digits = pattern.substr(percent + 1, end - percent - 1);
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 2) return pattern;
    const int width = digits.empty() ? 0 : std::stoi(digits);
    const std::string number = !digits.empty() && digits[0] == '0' ? fmt::format("{:0{}}", n, width)
                                                                   : fmt::format("{:{}}", n, width);
    return pattern.substr(0, percent) + number + pattern.substr(end + 1);
}

std::vector<fs::path> listedFiles(const fs::path& header, const std::string& text, std::size_t at) {
    std::vector<fs::path> files;
    std::string line;
    while (nextLine(text, at, line)) {
        if (trimmedText(line).empty()) continue;
        if (files.size() == kMostFiles) refuseTooMany(header);
        files.push_back(besideHeader(header, trimmedText(line)));
    }
    return files;
}

std::vector<fs::path> numberedFiles(const fs::path& header, const std::string& pattern, std::int64_t first,
                                    std::int64_t last, std::int64_t step) {
    constexpr std::int64_t kMost = 1'000'000'000;
    if (step == 0 || std::abs(first) > kMost || std::abs(last) > kMost || std::abs(step) > kMost)
        throw Error(header.string(), "",
                    fmt::format("expected data files with numbers from one to another, found {} to {} by {}",
                                first, last, step),
                    "correct it in the header");
    std::vector<fs::path> files;
    for (std::int64_t n = first; step > 0 ? n <= last : n >= last; n += step) {
        if (files.size() == kMostFiles) refuseTooMany(header);
        files.push_back(besideHeader(header, numberedName(pattern, n)));
    }
    return files;
}

std::optional<double> millimetresOf(const std::string& unit) {
    static constexpr struct {
        const char* name;
        double millimetres;
    } kUnits[] = {{"mm", 1},
                  {"millimeter", 1},
                  {"millimeters", 1},
                  {"millimetre", 1},
                  {"millimetres", 1},
                  {"um", 1e-3},
                  {"\xc2\xb5m", 1e-3},
                  {"\xce\xbcm", 1e-3},
                  {"micron", 1e-3},
                  {"microns", 1e-3},
                  {"micrometer", 1e-3},
                  {"micrometers", 1e-3},
                  {"micrometre", 1e-3},
                  {"nm", 1e-6},
                  {"nanometer", 1e-6},
                  {"cm", 10},
                  {"centimeter", 10},
                  {"centimetre", 10},
                  {"m", 1e3},
                  {"meter", 1e3},
                  {"meters", 1e3},
                  {"metre", 1e3},
                  {"in", 25.4},
                  {"inch", 25.4}};
    const std::string wanted = loweredText(unit);
    for (const auto& known : kUnits)
        if (wanted == known.name) return known.millimetres;
    return {};
}

}  // namespace stereonav
