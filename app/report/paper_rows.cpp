#include "app/report/paper_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/report/model.h"
#include "engine/text/csv_text.h"

namespace stereonav {
namespace {

std::string csvNumber(const std::optional<double>& value) {
    return value ? fmt::format("{:.9g}", *value) : "";
}

ReportFigure figureOf(const PaperRow& row) {
    using Kind = ReportFigure::Kind;
    const Kind kind = row.kind == PaperRow::Kind::Time    ? Kind::Time
                      : row.kind == PaperRow::Kind::Error ? Kind::Error
                                                          : Kind::Other;
    return {fmt::format("papers/{}/{}/{}/{}", row.paper, row.table, row.row, row.column), row.unit,
            row.measured, kind, row.ours};
}

using TableName = std::pair<std::string, std::string>;  // name of the paper, and of its table

TableName nameOf(const PaperRow& row) {
    return {row.paper, row.table};
}

ReportTable tableOf(const std::vector<PaperRow>& rows, const TableName& name) {
    const auto isRate = [&](const PaperRow& row) { return nameOf(row) == name && !row.how.empty(); };
    const bool rates = std::any_of(rows.begin(), rows.end(), isRate);
    ReportTable table{
        name.first + ", " + name.second, "", {"", "", "the paper", "ours", "unit", "ours / theirs"}, {}};
    if (rates) table.columns.emplace_back("how");
    for (const PaperRow& row : rows) {
        if (nameOf(row) != name) continue;
        const auto ratio = ratioToTheirs(row);
        std::vector<std::string> cells{row.row,       row.column, theirsText(row),
                                       oursText(row), row.unit,   ratio ? numberText(*ratio) : ""};
        if (rates) cells.push_back(row.how);
        table.rows.push_back(std::move(cells));
        table.notes.push_back(fmt::format("Measured on: {}. Why it differs: {}", row.measured, row.why));
    }
    return table;
}

}  // namespace

std::string theirsText(const PaperRow& row) {
    return row.theirs ? numberText(*row.theirs) : row.said;
}

std::string oursText(const PaperRow& row) {
    return row.ours.count > 0 ? spreadText(row.ours) : row.none;
}

std::optional<double> ratioToTheirs(const PaperRow& row) {
    if (!row.theirs || *row.theirs == 0 || row.ours.count == 0) return std::nullopt;
    return (row.kind == PaperRow::Kind::Time ? row.ours.low : row.ours.median) / *row.theirs;
}

void addPaperRows(Report& report, ReportSection& section, std::vector<PaperRow> rows) {
    std::vector<TableName> tables;
    for (const PaperRow& row : rows)
        if (std::find(tables.begin(), tables.end(), nameOf(row)) == tables.end())
            tables.push_back(nameOf(row));
    for (const TableName& table : tables) section.blocks.emplace_back(tableOf(rows, table));
    for (PaperRow& row : rows) {
        if (row.ours.count > 0) addFigure(report, figureOf(row));
        report.papers.push_back(std::move(row));
    }
}

std::string papersCsv(const std::vector<PaperRow>& rows) {
    std::string csv = "paper,table,row,column,theirs,said,ours,low,high,count,none,unit,measured,how,why\n";
    for (const PaperRow& row : rows) {
        const bool has = row.ours.count > 0;
        const auto ours = [has](double value) {
            return csvNumber(has ? std::optional(value) : std::nullopt);
        };
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csvText(row.paper),
                           csvText(row.table), csvText(row.row), csvText(row.column), csvNumber(row.theirs),
                           csvText(row.said), ours(row.ours.median), ours(row.ours.low), ours(row.ours.high),
                           row.ours.count, csvText(row.none), csvText(row.unit), csvText(row.measured),
                           csvText(row.how), csvText(row.why));
    }
    return csv;
}

}  // namespace stereonav
