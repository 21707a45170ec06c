// Facts about a scene: figures with their names and units, as a tree. Text for people, rows of a report and
// JSON (engine/scene/facts_json.h) are all made from them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stereonav {

struct Fact;
using Facts = std::vector<Fact>;

using FactIntegers = std::vector<std::int64_t>;
using FactNumbers = std::vector<double>;
using FactWords = std::vector<std::string>;
using FactValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, FactIntegers,
                               FactNumbers, FactWords, Facts, std::vector<Facts>>;

struct Fact {
    std::string key;  // key of the value in JSON; "": not in JSON
    FactValue value;
    std::string unit;  // unit of the value, "mm"; "": none, or part of the text
    // Label in text; "": the fact continues the one before. Empty: not in the text.
    std::optional<std::string> label;
    std::string text;  // "": the value and its unit, as they are
};

// Makes a fact for JSON only.
Fact factForJson(std::string key, FactValue value, std::string unit = "");
// Makes a fact for people only: words on several values, or on a value that has a key elsewhere.
Fact factForText(std::string label, std::string text);
// Makes a fact for both; text as in Fact.
Fact factForAll(std::string key, FactValue value, std::string label, std::string text = "",
                std::string unit = "");

// Collects facts of these three kinds.
class FactList {
public:
    void json(std::string key, FactValue value, std::string unit = "") {
        mFacts.push_back(factForJson(std::move(key), std::move(value), std::move(unit)));
    }
    void text(std::string label, std::string words) {
        mFacts.push_back(factForText(std::move(label), std::move(words)));
    }
    void both(std::string key, FactValue value, std::string label, std::string words = "",
              std::string unit = "") {
        mFacts.push_back(factForAll(std::move(key), std::move(value), std::move(label), std::move(words),
                                    std::move(unit)));
    }
    Facts& facts() { return mFacts; }

private:
    Facts mFacts;
};

// Returns lines "  label       text\n". The label of a group (Facts) is a heading on a line of its own; the
// facts of groups and of lists of groups follow, whether the group has a label or not.
std::string linesOf(const Facts& facts);
// Returns label and text of each of these lines, without headings.
std::vector<std::pair<std::string, std::string>> rowsOf(const Facts& facts);

}  // namespace stereonav
