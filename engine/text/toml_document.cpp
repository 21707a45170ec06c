// TOML through toml11. Its own messages span several lines; here each becomes one.
#include "engine/text/toml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <toml.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/text/similar.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

constexpr std::size_t kLargestFile = 256 << 10;  // bytes: the parser takes the square of the sections
constexpr int kDeepestNesting = 32;              // brackets: the parser recurses
constexpr std::size_t kLongestLine = 4096;       // bytes: so are the parts of a dotted key

// To tell a value's line all before it is counted: of more problems the lines are not told.
constexpr std::size_t kMostTold = 20;
constexpr std::size_t kLongestKey = 60;  // bytes: no key that there is comes near

int lineOf(const toml::value& value) {
    return static_cast<int>(value.location().line());
}

// A value as an error message shows it.
std::string shown(const toml::value& value) {
    if (value.is_string()) {
        const std::string text = value.as_string().str;
        const std::string_view first = firstBytes(text, 40);
        return fmt::format("\"{}{}\"", first, first.size() < text.size() ? "..." : "");
    }
    if (value.is_integer()) return std::to_string(value.as_integer());
    if (value.is_floating()) return fmt::format("{:g}", value.as_floating());
    if (value.is_boolean()) return value.as_boolean() ? "true" : "false";
    if (value.is_array()) return fmt::format("a list of {}", value.as_array().size());
    return value.is_table() ? "a table" : "a date or time";
}

std::string described(const NumberRange& range, const std::string& what) {
    const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
    std::string text = what;
    if (low && high && !range.openLow && !range.openHigh) {
        text += fmt::format(" from {} to {}", shortNumber(range.low), shortNumber(range.high));
    } else {
        if (low) text += (range.openLow ? " above " : " of at least ") + shortNumber(range.low);
        if (low && high) text += " and";
        if (high) text += (range.openHigh ? " below " : " of at most ") + shortNumber(range.high);
    }
    return *range.unit ? text + " " + range.unit : text;
}

bool isNumberIn(const toml::value& value, const NumberRange& range, double& number) {
    if (value.is_integer())
        number = static_cast<double>(value.as_integer());
    else if (value.is_floating())
        number = value.as_floating();
    else
        return false;
    return range.holds(number);
}

// The parser recurses into brackets; hostile files are refused before it sees them.
void checkShape(const std::string& content, const std::string& file) {
    if (content.size() > kLargestFile)
        throw Error(file, "",
                    fmt::format("expected a scene of at most 256 KiB, got {} bytes", content.size()),
                    "name a scene file");
    int line = 1, depth = 0;
    std::size_t length = 0;
    for (const char c : content) {
        length = c == '\n' ? 0 : length + 1;
        line += c == '\n';
        depth += c == '[' || c == '{';
        depth -= (c == ']' || c == '}') && depth > 0;
        if (depth > kDeepestNesting || length > kLongestLine)
            throw Error(file, std::to_string(line),
                        depth > kDeepestNesting ? "brackets are nested too deeply" : "the line is too long",
                        "name a scene file");
    }
}

// toml11 writes "[error] toml::where: what", the line, and a remark below it; kept are what and remark.
std::string condensed(const std::string& message) {
    std::string what = message.substr(0, message.find('\n'));
    for (const std::string prefix : {"[error] ", "toml::"})
        if (what.rfind(prefix, 0) == 0) what.erase(0, prefix.size());
    if (const auto colon = what.find(": "); colon != std::string::npos && what.find(' ') > colon)
        what.erase(0, colon + 2);
    std::string remark;
    if (const auto mark = message.find("^---"); mark != std::string::npos)
        remark = message.substr(mark + 4, message.find('\n', mark) - mark - 4);
    remark.erase(0, std::min(remark.find_first_not_of(' '), remark.size()));
    while (!what.empty() && what.back() == '.') what.pop_back();
    return remark.empty() || remark == "here" ? what : what + ": " + remark;
}

toml::value parsed(const std::filesystem::path& file) {
    const std::string content = readTextFile(file);
    checkShape(content, file.string());
    const std::string advice = "correct the line; TOML has [section] lines and key = value, text in quotes";
    try {
        std::istringstream in(content);
        return toml::parse(in, file.string());
    } catch (const toml::exception& error) {
        throw Error(file.string(), std::to_string(error.location().line()), condensed(error.what()), advice);
    } catch (const std::exception& error) {
        throw Error(file.string(), "", "is not TOML: " + condensed(error.what()), advice);
    }
}

struct Problem {
    int line;
    std::string key, problem, advice;
};

struct UnknownKey {
    int line;
    std::string text;
};

struct Unknown {
    std::vector<UnknownKey> told;
    std::size_t more = 0;
};

}  // namespace

struct TomlDocument::State {
    std::string file;
    toml::value root;
    std::map<std::string, std::set<std::string>> known;  // asked for, by section
    std::set<std::string> misshapen;                     // not the section or list of sections asked for
    std::vector<Problem> problems;

    static const toml::value* find(const toml::value& table, const std::string& key) {
        const auto& entries = table.as_table();
        const auto it = entries.find(key);
        return it == entries.end() ? nullptr : &it->second;
    }

    // Returns what is wrong with a key that nobody asked for, and what may have been meant.
    std::string unknownText(const std::string& key, const std::string& sectionName) const {
        const std::string where = sectionName.empty() ? "" : fmt::format(" in [{}]", sectionName);
        if (key.size() > kLongestKey) return fmt::format("\"{}...\"{}", key.substr(0, kLongestKey), where);
        for (const auto& [other, keys] : known)
            if (other != sectionName && keys.count(key) > 0)
                return fmt::format("\"{}\"{} (belongs in [{}])", key, where, other);
        const auto& candidates = sectionName.empty() ? sectionNames() : known.at(sectionName);
        return fmt::format("\"{}\"{} (nearest: \"{}\")", key, where, nearestWord(key, candidates));
    }

    std::set<std::string> sectionNames() const {
        std::set<std::string> names;
        for (const auto& entry : known) names.insert(entry.first);
        return names;
    }

    void addUnknown(const std::string& key, const toml::value& value, const std::string& section,
                    Unknown& found) const {
        if (found.told.size() < kMostTold)
            found.told.push_back({lineOf(value), unknownText(key, section)});
        else
            ++found.more;
    }

    void collectUnknown(const toml::value& table, const std::string& name, Unknown& found) const {
        if (!table.is_table()) return;
        for (const auto& [key, value] : table.as_table())
            if (known.at(name).count(key) == 0) addUnknown(key, value, name, found);
    }

    // only: of this section; "": of all.
    Unknown unknownKeys(const std::string& only) const {
        Unknown found;
        for (const auto& [key, value] : root.as_table()) {
            if (!only.empty() && key != only) continue;
            if (misshapen.count(key) > 0)
                continue;
            else if (known.count(key) == 0)
                addUnknown(key, value, "", found);
            else if (value.is_array())
                for (const auto& table : value.as_array()) collectUnknown(table, key, found);
            else
                collectUnknown(value, key, found);
        }
        std::sort(found.told.begin(), found.told.end(), [](const UnknownKey& a, const UnknownKey& b) {
            return std::tie(a.line, a.text) < std::tie(b.line, b.text);
        });
        return found;
    }

    void finish(const std::string& only) const;
};

TomlDocument::TomlDocument(const std::filesystem::path& file) : mState(std::make_unique<State>()) {
    mState->file = file.string();
    mState->root = parsed(file);
}

TomlDocument::~TomlDocument() = default;

TomlSection TomlDocument::section(const std::string& name) {
    mState->known[name];
    const toml::value* table = State::find(mState->root, name);
    if (table && !table->is_table()) {
        mState->misshapen.insert(name);
        mState->problems.push_back({lineOf(*table), name,
                                    fmt::format("expected a section [{}], got {}", name, shown(*table)),
                                    fmt::format("write [{}] on a line of its own, its keys below", name)});
        table = nullptr;
    }
    return TomlSection(*mState, name, table);
}

std::string TomlDocument::rootText(const std::string& key) {
    mState->known[key];
    const toml::value* value = State::find(mState->root, key);
    if (!value) return "";
    if (value->is_string()) return value->as_string().str;
    mState->misshapen.insert(key);
    mState->problems.push_back({lineOf(*value), key,
                                fmt::format("expected text in quotes, got {}", shown(*value)),
                                "correct the value"});
    return "";
}

std::vector<TomlSection> TomlDocument::sections(const std::string& name) {
    mState->known[name];
    std::vector<TomlSection> result;
    const toml::value* list = State::find(mState->root, name);
    if (!list) return result;
    const bool tables = list->is_array() && std::all_of(list->as_array().begin(), list->as_array().end(),
                                                        [](const toml::value& v) { return v.is_table(); });
    if (!tables) {
        mState->misshapen.insert(name);
        mState->problems.push_back({lineOf(*list), name,
                                    fmt::format("expected sections [[{}]], got {}", name, shown(*list)),
                                    fmt::format("write [[{}]] for each, its keys below", name)});
        return result;
    }
    for (const toml::value& table : list->as_array()) result.push_back(TomlSection(*mState, name, &table));
    return result;
}

void TomlDocument::finish() const {
    mState->finish("");
}

void TomlDocument::finishSection(const std::string& name) const {
    mState->finish(name);
}

void TomlDocument::State::finish(const std::string& only) const {
    const auto [unknown, more] = unknownKeys(only);
    if (!unknown.empty()) {
        std::string text = unknown.size() == 1 ? "unknown key " : "unknown keys ";
        for (std::size_t k = 0; k < unknown.size(); ++k)
            text += (k ? fmt::format(", line {}: ", unknown[k].line) : "") + unknown[k].text;
        if (more > 0) text += fmt::format(", and {} more", more);
        throw Error(file, std::to_string(unknown.front().line), text, "correct or remove them");
    }
    if (problems.empty()) return;
    const Problem& first = *std::min_element(
        problems.begin(), problems.end(), [](const Problem& a, const Problem& b) { return a.line < b.line; });
    const std::string key = first.key.empty() ? "" : "\"" + first.key + "\": ";
    throw Error(file, first.line > 0 ? std::to_string(first.line) : "", key + first.problem, first.advice);
}

// The one place that turns the opaque table back: a key's value, or null.
struct TomlSection::Place {
    static const toml::value* find(TomlSection& section, const std::string& key) {
        section.mDocument->known[section.mName].insert(key);
        if (!section.mTable) return nullptr;
        return TomlDocument::State::find(*static_cast<const toml::value*>(section.mTable), key);
    }
    static void wrong(TomlSection& section, const std::string& key, const std::string& expected,
                      const toml::value& got) {
        section.note(key, fmt::format("expected {}, got {}", expected, shown(got)), "correct the value");
    }
};

bool TomlSection::has(const std::string& key) const {
    return mTable && TomlDocument::State::find(*static_cast<const toml::value*>(mTable), key);
}

void TomlSection::note(const std::string& key, const std::string& problem, const std::string& advice) {
    if (mDocument->problems.size() >= kMostTold) return;  // the first one is told
    int line = 0;
    if (mTable) {
        const auto& table = *static_cast<const toml::value*>(mTable);
        const toml::value* value = TomlDocument::State::find(table, key);
        line = lineOf(value ? *value : table);
    }
    mDocument->problems.push_back({line, key, problem, advice});
}

namespace {

// The text that an option of the command line would have; "" for what none takes.
std::string optionText(const toml::value& value) {
    if (value.is_string()) return value.as_string().str;
    if (value.is_boolean()) return value.as_boolean() ? "true" : "false";
    if (value.is_integer()) return std::to_string(value.as_integer());
    if (value.is_floating()) return fmt::format("{}", value.as_floating());
    return "";
}

bool isNumber(const toml::value& value) {
    return value.is_integer() || value.is_floating();
}

std::string joined(const toml::value& numbers) {
    std::string text;
    for (const toml::value& number : numbers.as_array())
        text += (text.empty() ? "" : ",") + optionText(number);
    return text;
}

// The texts of a list of texts, or of lists of numbers; nothing where it holds anything else.
std::vector<std::string> textsOf(const toml::value& list) {
    const auto& all = list.as_array();
    if (!all.empty() && std::all_of(all.begin(), all.end(), isNumber)) return {joined(list)};
    std::vector<std::string> texts;
    for (const toml::value& one : all) {
        const bool numbers = one.is_array() && !one.as_array().empty() &&
                             std::all_of(one.as_array().begin(), one.as_array().end(), isNumber);
        if (!one.is_string() && !numbers) return {};
        texts.push_back(numbers ? joined(one) : optionText(one));
    }
    return texts;
}

}  // namespace

std::vector<std::string> TomlSection::texts(const std::string& key) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return {};
    if (found->is_string() || found->is_boolean() || isNumber(*found)) return {optionText(*found)};
    std::vector<std::string> all = found->is_array() ? textsOf(*found) : std::vector<std::string>{};
    if (all.empty()) Place::wrong(*this, key, "a number, text, true or false, or a list", *found);
    return all;
}

bool TomlSection::isFlag(const std::string& key) const {
    if (!mTable) return false;
    const toml::value* value = TomlDocument::State::find(*static_cast<const toml::value*>(mTable), key);
    return value && value->is_boolean();
}

int TomlSection::line(const std::string& key) const {
    if (!mTable) return 0;
    const toml::value* value = TomlDocument::State::find(*static_cast<const toml::value*>(mTable), key);
    return value ? lineOf(*value) : 0;
}

void TomlSection::leave() {
    if (!mTable) return;
    for (const auto& [key, value] : static_cast<const toml::value*>(mTable)->as_table())
        mDocument->known[mName].insert(key);
}

void TomlSection::read(const std::string& key, bool& value) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return;
    if (found->is_boolean())
        value = found->as_boolean();
    else
        Place::wrong(*this, key, "true or false", *found);
}

void TomlSection::read(const std::string& key, std::string& value) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return;
    if (found->is_string() && !found->as_string().str.empty())
        value = found->as_string().str;
    else
        Place::wrong(*this, key, "text in quotes", *found);
}

void TomlSection::read(const std::string& key, double& value, const NumberRange& range) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return;
    if (double number = 0; isNumberIn(*found, range, number))
        value = number;
    else
        Place::wrong(*this, key, described(range, "a number"), *found);
}

void TomlSection::read(const std::string& key, std::span<double> values, const NumberRange& range) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return;
    const std::string expected = described(range, fmt::format("a list of {} numbers", values.size()));
    if (!found->is_array() || found->as_array().size() != values.size()) {
        Place::wrong(*this, key, expected, *found);
        return;
    }
    std::vector<double> numbers(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const toml::value& entry = found->as_array()[k];
        if (!isNumberIn(entry, range, numbers[k])) {
            Place::wrong(*this, key, expected, entry);
            return;
        }
    }
    std::copy(numbers.begin(), numbers.end(), values.begin());
}

void TomlSection::read(const std::string& key, std::int64_t& value, std::int64_t low, std::int64_t high) {
    const toml::value* found = Place::find(*this, key);
    if (!found) return;
    if (found->is_integer() && found->as_integer() >= low && found->as_integer() <= high)
        value = found->as_integer();
    else
        Place::wrong(*this, key, fmt::format("a whole number from {} to {}", low, high), *found);
}

void TomlSection::readDegrees(const std::string& key, double& value, const NumberRange& rangeDegrees) {
    double degrees = value * 180 / std::numbers::pi;
    const double before = degrees;
    read(key, degrees, rangeDegrees);
    if (degrees != before) value = degrees * std::numbers::pi / 180;
}

}  // namespace stereonav
