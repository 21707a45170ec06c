#include "app/report/stability.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/text/json_check.h"

namespace stereonav {
namespace {

using Json = nlohmann::json;

constexpr const char* kRowsAdvice = "make the rows anew: ninja -C build/release stability_rows";

struct Row {
    std::string id, words, quantity, unit;
    double worst = NAN, bound = NAN;
    bool pass = false;
};

// Reads a number; those that are not finite are written as null or as text.
double numberFrom(const Json& value) {
    return value.is_number() ? value.get<double>() : NAN;
}

Row rowFrom(const std::string& line, const std::string& source, int number) {
    checkJson(line, source, kRowsAdvice);
    try {
        const Json json = Json::parse(line);
        return {json.at("id").get<std::string>(),
                json.at("case").get<std::string>(),
                json.at("quantity").get<std::string>(),
                json.at("unit").get<std::string>(),
                numberFrom(json.at("worst")),
                numberFrom(json.at("bound")),
                json.at("pass").get<bool>()};
    } catch (const nlohmann::json::exception&) {
        throw Error(source, std::to_string(number),
                    "expected a row of the stability tests, found \"" + line.substr(0, 40) + "\"",
                    kRowsAdvice);
    }
}

std::string groupOf(const std::string& id) {
    const std::size_t slash = id.find('/');
    return slash == std::string::npos ? "others" : id.substr(0, slash);
}

ReportTable tableOf(const std::string& group, const std::vector<Row>& rows) {
    ReportTable table{group, "", {"case", "what", "worst seen", "bound", "unit", "", "row"}, {}};
    for (const Row& r : rows)
        table.rows.push_back({r.words, r.quantity, numberText(r.worst), numberText(r.bound), r.unit,
                              r.pass ? "pass" : "FAIL", r.id});
    return table;
}

ReportSection emptySection() {
    return {"stability", "Stability on stiff and extreme cases", "", {}};
}

}  // namespace

ReportSection stabilitySection(std::string_view text, const std::string& source) {
    std::map<std::string, Row> rows;  // the later of two rows with one name counts
    int number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line(text.substr(at, end - at));
        at = end + 1;
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        Row row = rowFrom(line, source, number);
        rows[row.id] = std::move(row);
    }
    if (rows.empty()) return noStabilitySection();
    std::map<std::string, std::vector<Row>> groups;
    std::size_t failed = 0;
    for (const auto& [id, row] : rows) {
        groups[groupOf(id)].push_back(row);
        failed += !row.pass;
    }
    ReportSection section = emptySection();
    section.text =
        fmt::format("{} rows, each printed by the test that measured it, of which {}. From {}.", rows.size(),
                    failed == 0 ? "all pass" : fmt::format("{} FAIL", failed), source);
    for (const auto& [group, list] : groups) section.blocks.emplace_back(tableOf(group, list));
    return section;
}

ReportSection noStabilitySection() {
    ReportSection section = emptySection();
    section.blocks.emplace_back(ReportText{
        "No rows were given. The tests write them: ninja -C build/release stability_rows leaves "
        "stability_rows.jsonl beside the build, where the report looks, or name it with --stability FILE."});
    return section;
}

std::filesystem::path stabilityRowsOfThisBuild() {
    std::error_code code;
    const std::filesystem::path program = programFile();
    if (program.empty()) return {};
    const std::filesystem::path rows = program.parent_path().parent_path() / "stability_rows.jsonl";
    return std::filesystem::exists(rows, code) ? rows : std::filesystem::path();
}

}  // namespace stereonav
