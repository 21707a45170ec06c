#include "app/report/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/text/csv_text.h"
#include "engine/text/json_check.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr int kFewRepeats = 3;  // with fewer repeats the spread is not reliable
constexpr const char* kFormat = "stereonav report";

const char* nameOf(ReportFigure::Kind kind) {
    return kind == ReportFigure::Kind::Time ? "time" : kind == ReportFigure::Kind::Error ? "error" : "other";
}

ReportFigure::Kind kindFromName(const std::string& name) {
    return name == "time"    ? ReportFigure::Kind::Time
           : name == "error" ? ReportFigure::Kind::Error
                             : ReportFigure::Kind::Other;
}

Json papersJson(const std::vector<PaperRow>& rows) {
    Json list = Json::array();
    for (const PaperRow& row : rows) {
        const bool has = row.ours.count > 0;
        const auto ours = [has](double value) { return has ? Json(value) : Json(); };
        list.push_back({{"paper", row.paper},
                        {"table", row.table},
                        {"row", row.row},
                        {"column", row.column},
                        {"theirs", row.theirs ? Json(*row.theirs) : Json()},
                        {"said", row.said},
                        {"ours", ours(row.ours.median)},
                        {"low", ours(row.ours.low)},
                        {"high", ours(row.ours.high)},
                        {"count", row.ours.count},
                        {"none", row.none},
                        {"unit", row.unit},
                        {"measured", row.measured},
                        {"how", row.how},
                        {"why", row.why}});
    }
    return list;
}

ReportFigure figureFrom(const nlohmann::json& json) {
    ReportFigure figure;
    figure.id = json.at("id").get<std::string>();
    figure.unit = json.at("unit").get<std::string>();
    figure.setting = json.at("setting").get<std::string>();
    figure.kind = kindFromName(json.at("kind").get<std::string>());
    figure.value = {json.at("median").get<double>(), json.at("low").get<double>(),
                    json.at("high").get<double>(), json.at("count").get<int>()};
    return figure;
}

const ReportFigure* find(const std::vector<ReportFigure>& figures, const std::string& id) {
    const auto at =
        std::find_if(figures.begin(), figures.end(), [&](const ReportFigure& f) { return f.id == id; });
    return at == figures.end() ? nullptr : &*at;
}

double moodOf(const std::vector<ReportFigure>& figures) {
    const ReportFigure* mood = find(figures, kMoodFigure);
    return mood ? mood->value.relative() : 0.0;
}

bool isJudged(const ReportFigure& figure) {
    return figure.kind != ReportFigure::Kind::Other && figure.value.count > 0 && figure.id != kMoodFigure;
}

// Returns the value to compare; for times the least one, since other work on the machine can only add to it.
double judgedValue(const ReportFigure& figure) {
    return figure.kind == ReportFigure::Kind::Time ? figure.value.low : figure.value.median;
}

ReportChange changeOf(const ReportFigure& before, const ReportFigure& after, double mood) {
    using Verdict = ReportChange::Verdict;
    const bool time = before.kind == ReportFigure::Kind::Time;
    ReportChange change{after.id, after.unit, before.value, after.value, kErrorBound, Verdict::Same};
    if (time)
        change.bound = std::max(kLeastTimeBound, before.value.relative() + after.value.relative() + mood);
    if (time && std::min(before.value.count, after.value.count) < kFewRepeats)
        change.bound += kLeastTimeBound;
    const double from = judgedValue(before), to = judgedValue(after);
    const double slack = change.bound * std::abs(from) + (time ? 0.0 : kLeastError);
    if (to > from + slack) change.verdict = Verdict::Worse;
    // The bound is symmetric: half the time is as far away as twice the time.
    if (from > to + change.bound * std::abs(to) + (time ? 0.0 : kLeastError))
        change.verdict = Verdict::Better;
    return change;
}

double ratioOf(const ReportChange& change) {
    return change.before.median > 0  ? change.after.median / change.before.median
           : change.after.median > 0 ? 1e9
                                     : 1;
}

const char* wordFor(ReportChange::Verdict verdict) {
    return verdict == ReportChange::Verdict::Worse    ? "worse"
           : verdict == ReportChange::Verdict::Better ? "better"
                                                      : "same";
}

std::string listed(const std::vector<std::string>& ids) {
    constexpr std::size_t kMost = 12;
    std::string text;
    for (std::size_t n = 0; n < std::min(ids.size(), kMost); ++n) text += (n ? ", " : "") + ids[n];
    return ids.size() > kMost ? fmt::format("{} and {} more", text, ids.size() - kMost) : text;
}

}  // namespace

std::string figuresJson(const Report& report) {
    Json json;
    json["format"] = kFormat;
    json["version"] = kVersion;
    json["quick"] = report.quick;
    json["machine"] = Json::object();
    for (const auto& [name, value] : report.machine) json["machine"][name] = value;
    json["warnings"] = report.warnings;
    json["figures"] = Json::array();
    for (const ReportFigure& f : report.figures)
        json["figures"].push_back({{"id", f.id},
                                   {"kind", nameOf(f.kind)},
                                   {"median", f.value.median},
                                   {"low", f.value.low},
                                   {"high", f.value.high},
                                   {"count", f.value.count},
                                   {"unit", f.unit},
                                   {"setting", f.setting}});
    if (!report.papers.empty()) json["papers"] = papersJson(report.papers);
    return jsonText(json, 1) + "\n";
}

std::string figuresCsv(const Report& report) {
    std::string csv = "id,kind,median,low,high,count,unit,setting\n";
    for (const ReportFigure& f : report.figures)
        csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{},{},{}\n", csvText(f.id), nameOf(f.kind),
                           f.value.median, f.value.low, f.value.high, f.value.count, csvText(f.unit),
                           csvText(f.setting));
    return csv;
}

EarlierReport readEarlierReport(const std::filesystem::path& file) {
    const std::string content = readTextFile(file);
    const char* advice = "name the report.json that an earlier stereonav report wrote";
    checkJson(content, file.string(), advice);
    try {
        const auto json = nlohmann::json::parse(content);  // ordered_json is slow for large objects
        if (json.at("format") != kFormat || json.at("version") != kVersion)
            throw Error(file.string(), "", fmt::format("expected version {} of a report", kVersion), advice);
        EarlierReport report;
        report.quick = json.at("quick").get<bool>();
        for (const auto& [name, value] : json.at("machine").items())
            report.machine.emplace_back(name, value.get<std::string>());
        for (const nlohmann::json& figure : json.at("figures")) report.figures.push_back(figureFrom(figure));
        return report;
    } catch (const nlohmann::json::parse_error& error) {
        throw Error(file.string(), "",
                    fmt::format("expected a report as JSON, found what is none at byte {}", error.byte),
                    advice);
    } catch (const nlohmann::json::exception&) {
        throw Error(file.string(), "", "expected a report, found JSON of something else", advice);
    }
}

bool ReportComparison::worse() const {
    return std::any_of(changes.begin(), changes.end(),
                       [](const ReportChange& c) { return c.verdict == ReportChange::Verdict::Worse; });
}

ReportComparison compareReports(const EarlierReport& before, const Report& after) {
    ReportComparison comparison;
    const double mood = moodOf(before.figures) + moodOf(after.figures);
    for (const ReportFigure& f : after.figures) {
        if (!isJudged(f)) continue;
        const ReportFigure* earlier = find(before.figures, f.id);
        if (!earlier || !isJudged(*earlier))
            comparison.added.push_back(f.id);
        else if (earlier->setting != f.setting || earlier->kind != f.kind || before.quick != after.quick)
            comparison.otherwise.push_back(f.id);
        else
            comparison.changes.push_back(changeOf(*earlier, f, mood));
    }
    for (const ReportFigure& f : before.figures)
        if (isJudged(f) && !find(after.figures, f.id)) comparison.gone.push_back(f.id);
    std::stable_sort(comparison.changes.begin(), comparison.changes.end(),
                     [](const ReportChange& a, const ReportChange& b) { return ratioOf(a) > ratioOf(b); });
    return comparison;
}

ReportSection comparisonSection(const ReportComparison& comparison, const EarlierReport& before,
                                const std::string& file) {
    using Verdict = ReportChange::Verdict;
    ReportSection section{"compared", "Compared with an earlier run", "", {}};
    int worse = 0, better = 0;
    for (const ReportChange& c : comparison.changes)
        worse += c.verdict == Verdict::Worse, better += c.verdict == Verdict::Better;
    section.text = fmt::format(
        "With {}: of {} times and errors {} got worse and {} better beyond the noise. Of times the least of "
        "the repeats are compared, within what repeats of both runs and the machine itself spread by, at "
        "least {:.0f} %; errors, which repeat exactly, within {:.0f} %.",
        file, comparison.changes.size(), worse, better, 100 * kLeastTimeBound, 100 * kErrorBound);
    ReportTable table{"What moved", "", {"figure", "before", "now", "unit", "ratio", "bound", "verdict"}, {}};
    for (const ReportChange& c : comparison.changes)
        if (c.verdict != Verdict::Same)
            table.rows.push_back({c.id, spreadText(c.before), spreadText(c.after), c.unit,
                                  numberText(ratioOf(c)), fmt::format("{:.0f} %", 100 * c.bound),
                                  wordFor(c.verdict)});
    if (table.rows.empty()) table.text = "Nothing moved beyond the noise.";
    section.blocks.emplace_back(std::move(table));
    ReportTable runs{"Both runs", "", {"", "before"}, {}};
    for (const auto& [name, value] : before.machine) runs.rows.push_back({name, value});
    const auto also = [&](const char* title, const std::vector<std::string>& ids) {
        if (!ids.empty()) runs.rows.push_back({title, listed(ids)});
    };
    also("only measured before", comparison.gone);
    also("only measured now", comparison.added);
    also("measured in another setting, not compared", comparison.otherwise);
    section.blocks.emplace_back(std::move(runs));
    return section;
}

}  // namespace stereonav
