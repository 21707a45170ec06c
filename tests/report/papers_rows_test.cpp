// Rows of papers beside ours: what the page, report.json and papers.csv print of them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/report/json.h"
#include "app/report/page.h"
#include "app/report/paper_rows.h"
#include "engine/base/error.h"
#include "tests/support/xml_check.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

PaperRow rowOf(const std::string& table, const std::string& row, const std::string& column) {
    PaperRow r;
    r.paper = "Some and others";
    r.table = table;
    r.row = row;
    r.column = column;
    r.theirs = 2;
    r.ours = {3, 2.5, 4, 5};
    r.unit = "s";
    r.measured = "a scene";
    r.why = "because <of> \"this\"";
    r.kind = PaperRow::Kind::Time;
    return r;
}

// Two of one table, one that they say in words, and one that is not measured.
std::vector<PaperRow> someRows() {
    std::vector<PaperRow> rows{rowOf("Table 1", "left", "1"), rowOf("Table 1", "left", "2"),
                               rowOf("Fig. 2", "noise", "1"), rowOf("Fig. 2", "noise", "16")};
    rows[2].theirs.reset();
    rows[2].said = "a picture";
    rows[2].kind = PaperRow::Kind::Error;
    rows[3].ours = {};
    rows[3].none = "this machine runs 2 threads";
    return rows;
}

Report reportOf(std::vector<PaperRow> rows) {
    Report report;
    ReportSection section{"papers", "Papers", "", {}};
    addPaperRows(report, section, std::move(rows));
    report.sections.push_back(std::move(section));
    return report;
}

std::size_t countOf(const std::string& text, const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
    return count;
}

TEST(PaperRows, RatioIsOursOverTheirsWhereBothAreThere) {
    const std::vector<PaperRow> rows = someRows();
    EXPECT_DOUBLE_EQ(*ratioToTheirs(rows[0]), 1.25) << "of times the least";
    PaperRow other = rows[0];
    other.kind = PaperRow::Kind::Other;
    EXPECT_DOUBLE_EQ(*ratioToTheirs(other), 1.5);
    EXPECT_FALSE(ratioToTheirs(rows[2])) << "they give words";
    EXPECT_FALSE(ratioToTheirs(rows[3])) << "ours is not measured";
    PaperRow none = rows[0];
    none.theirs = 0;
    EXPECT_FALSE(ratioToTheirs(none));
}

TEST(PaperRows, BecomeTablesFiguresAndRows) {
    const Report report = reportOf(someRows());
    ASSERT_EQ(report.papers.size(), 4u);
    ASSERT_EQ(report.sections[0].blocks.size(), 2u);
    const auto& table = std::get<ReportTable>(report.sections[0].blocks[1]);
    EXPECT_EQ(table.title, "Some and others, Fig. 2");
    ASSERT_EQ(table.rows.size(), 2u);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
    EXPECT_EQ(table.rows[0][2], "a picture");
    EXPECT_EQ(table.rows[1][3], "this machine runs 2 threads");
    // what is not measured is no figure
    ASSERT_EQ(report.figures.size(), 3u);
    EXPECT_EQ(report.figures[0].id, "papers/Some and others/Table 1/left/1");
    EXPECT_EQ(report.figures[0].kind, ReportFigure::Kind::Time);
    EXPECT_EQ(report.figures[0].value.low, 2.5);
    EXPECT_EQ(report.figures[0].setting, "a scene");
    EXPECT_EQ(report.figures[2].kind, ReportFigure::Kind::Error);
}

TEST(PaperRows, TheSameRowTwiceIsAMistake) {
    EXPECT_THROW(reportOf({rowOf("Table 1", "left", "1"), rowOf("Table 1", "left", "1")}), Error);
}

TEST(PaperRows, HowIsAColumnWhereSomethingIsARate) {
    std::vector<PaperRow> rows = someRows();
    rows[1].how = "rate of 5 s on 1.2 %, scaled";
    const Report report = reportOf(rows);
    const auto &rates = std::get<ReportTable>(report.sections[0].blocks[0]),
               &others = std::get<ReportTable>(report.sections[0].blocks[1]);
    EXPECT_EQ(rates.columns.size(), others.columns.size() + 1);
    for (const auto& row : rates.rows) EXPECT_EQ(row.size(), rates.columns.size());
    EXPECT_EQ(rates.rows[1][6], "rate of 5 s on 1.2 %, scaled");
}

TEST(PaperRows, ThePageSaysOnceWhyRowsDiffer) {
    std::vector<PaperRow> rows = someRows();
    rows[3].why = "another reason";
    const std::string page = pageOf(reportOf(rows));
    EXPECT_EQ(test::xmlProblem(page), "");
    // two rows of one table share it, those of the other do not
    EXPECT_EQ(countOf(page, "because &lt;of&gt; &quot;this&quot;"), 2u);
    EXPECT_EQ(countOf(page, "another reason"), 1u);
    EXPECT_EQ(countOf(page, "Measured on: a scene. Why it differs: "), 3u);
    EXPECT_EQ(countOf(page, "<td>left</td>"), 1u) << "named once for both columns";
    EXPECT_EQ(countOf(page, "<td>noise</td>"), 2u) << "named again below a note";
    EXPECT_THAT(page, HasSubstr("this machine runs 2 threads"));
}

TEST(PaperRows, JsonHasThemWithWhatIsMissingAsNull) {
    const auto json = nlohmann::json::parse(figuresJson(reportOf(someRows())));
    const auto& papers = json.at("papers");
    ASSERT_EQ(papers.size(), 4u);
    EXPECT_EQ(papers[0].at("theirs"), 2.0);
    EXPECT_EQ(papers[0].at("ours"), 3.0);
    EXPECT_EQ(papers[0].at("count"), 5);
    EXPECT_TRUE(papers[2].at("theirs").is_null());
    EXPECT_EQ(papers[2].at("said"), "a picture");
    EXPECT_TRUE(papers[3].at("ours").is_null());
    EXPECT_EQ(papers[3].at("none"), "this machine runs 2 threads");
    for (const auto& row : papers)
        for (const char* field : {"paper", "table", "row", "column", "unit", "measured", "how", "why"})
            EXPECT_TRUE(row.at(field).is_string()) << field;
    EXPECT_FALSE(nlohmann::json::parse(figuresJson({})).contains("papers"));
}

TEST(PaperRows, CsvHasALineARowWithAllItsFields) {
    const std::string csv = papersCsv(someRows());
    EXPECT_EQ(countOf(csv, "\n"), 5u);
    EXPECT_THAT(
        csv,
        HasSubstr("\"Some and others\",\"Table 1\",\"left\",\"1\",2,\"\",3,2.5,4,5,\"\",\"s\",\"a scene\","
                  "\"\",\"because <of> \"\"this\"\"\"\n"));
    EXPECT_THAT(csv, HasSubstr("\"16\",2,\"\",,,,0,\"this machine runs 2 threads\","));
}

}  // namespace
}  // namespace stereonav
