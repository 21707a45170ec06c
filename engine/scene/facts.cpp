#include "engine/scene/facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/text/printable.h"

namespace stereonav {
namespace {

struct WordsOf {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(bool value) const { return value ? "yes" : "no"; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(double value) const { return fmt::format("{:.6g}", value); }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(const FactIntegers& values) const {
        return fmt::format("{}", fmt::join(values, " x "));
    }
    std::string operator()(const FactNumbers& values) const {
        return fmt::format("{:.6g}", fmt::join(values, " x "));
    }
    std::string operator()(const FactWords& values) const {
        return fmt::format("{}", fmt::join(values, ", "));
    }
    std::string operator()(const Facts&) const { return ""; }
    std::string operator()(const std::vector<Facts>& groups) const { return std::to_string(groups.size()); }
};

// Returns the text of a fact, made printable, since words of files may stand in it.
std::string textOf(const Fact& fact) {
    if (!fact.text.empty()) return printable(fact.text, kLongestLine);
    const std::string words = printable(std::visit(WordsOf{}, fact.value), kLongestLine);
    return fact.unit.empty() ? words : words + " " + fact.unit;
}

// Calls line(label, text) for each fact with a label, heading(label) for each group with one, in their order.
template <typename Line, typename Heading>
void walk(const Facts& facts, const Line& line, const Heading& heading) {
    for (const Fact& fact : facts) {
        const auto* const group = std::get_if<Facts>(&fact.value);
        if (fact.label && group) heading(printable(*fact.label));
        if (fact.label && !group) line(printable(*fact.label), textOf(fact));
        if (group) walk(*group, line, heading);
        if (const auto* const groups = std::get_if<std::vector<Facts>>(&fact.value))
            for (const Facts& each : *groups) walk(each, line, heading);
    }
}

}  // namespace

Fact factForJson(std::string key, FactValue value, std::string unit) {
    return {std::move(key), std::move(value), std::move(unit), std::nullopt, ""};
}

Fact factForText(std::string label, std::string text) {
    return {"", std::move(text), "", std::move(label), ""};
}

Fact factForAll(std::string key, FactValue value, std::string label, std::string text, std::string unit) {
    return {std::move(key), std::move(value), std::move(unit), std::move(label), std::move(text)};
}

std::string linesOf(const Facts& facts) {
    std::string lines;
    walk(
        facts,
        [&](const std::string& label, const std::string& text) {
            lines += fmt::format("  {:<12}{}\n", label, text);
        },
        [&](const std::string& label) { lines += label + "\n"; });
    return lines;
}

std::vector<std::pair<std::string, std::string>> rowsOf(const Facts& facts) {
    std::vector<std::pair<std::string, std::string>> rows;
    walk(
        facts, [&](const std::string& label, const std::string& text) { rows.emplace_back(label, text); },
        [](const std::string&) {});
    return rows;
}

}  // namespace stereonav
