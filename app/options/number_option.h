// Options of the command line that take numbers: each is declared with its range and unit, which help shows
// and which is checked while the line is read, before anything else is done.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/number_text.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stereonav {

// What help names the values of such options, and by which tests find them: all others are words and files.
constexpr const char* kNumberValue = "NUMBER";
constexpr const char* kNumbersValue = "NUMBERS";

// advice: what to write instead, "" for none.
CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
                       const std::string& help, const std::string& advice = "");
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::optional<double>& value,
                       const NumberRange& range, const std::string& help, const std::string& advice = "");
// Whole numbers.
CLI::Option* addNumber(CLI::App& command, const std::string& name, int& value, const NumberRange& range,
                       const std::string& help, const std::string& advice = "");
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::optional<int>& value,
                       const NumberRange& range, const std::string& help, const std::string& advice = "");
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::uint64_t& value,
                       const NumberRange& range, const std::string& help, const std::string& advice = "");

// Lists are kept as they are written: their numbers are read with the same list where they are used
// (numbersIn). The second may be given several times.
CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::string& text, const NumberList& list,
                        const std::string& help);
CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::vector<std::string>& texts,
                        const NumberList& list, const std::string& help);

}  // namespace stereonav
