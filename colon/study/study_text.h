// Text of volume headers: lines, words, numbers and the names of data files. Shared among colon/study/*.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stereonav {

inline constexpr std::size_t kLongestStudyHeader = 1 << 20;  // bytes

// Returns a text without blanks, line ends and quotation marks around it.
std::string trimmedText(const std::string& text);
std::string loweredText(std::string text);
// Returns a text for messages: printable, and no longer than a line.
std::string shortText(const std::string& text);

// Reads one line of text from `at` on, which moves behind it; false at the end.
bool nextLine(const std::string& text, std::size_t& at, std::string& line);

// Returns all numbers that the text begins with.
std::vector<double> numbersIn(const std::string& text);

// Returns a data file's name as a header has it, in the header's folder or below. Throws Error for one
// elsewhere.
std::filesystem::path besideHeader(const std::filesystem::path& header, const std::string& name);
// Returns the name by a pattern, "slice.%03d.raw", for n; the pattern itself where it has no place for a
// whole number.
std::string numberedName(const std::string& pattern, std::int64_t n);
// Returns the names on the lines from `at` on, one a line. Throws Error where there are too many.
std::vector<std::filesystem::path> listedFiles(const std::filesystem::path& header, const std::string& text,
                                               std::size_t at);
// Returns the names by a pattern, from first to last. Throws Error where the step is 0 or there are too many.
std::vector<std::filesystem::path> numberedFiles(const std::filesystem::path& header,
                                                 const std::string& pattern, std::int64_t first,
                                                 std::int64_t last, std::int64_t step);

// Returns the millimetres of a unit of length ("mm", "um", "cm", ...), none for other words.
std::optional<double> millimetresOf(const std::string& unit);

}  // namespace stereonav
