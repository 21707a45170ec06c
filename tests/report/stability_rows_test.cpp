// The stability table from rows as the tests of tests/stability write them.
#include <gmock/gmock.h>

#include "app/report/page.h"
#include "app/report/stability.h"
#include "engine/base/error.h"
#include "tests/support/xml_check.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

std::string row(const std::string& id, const std::string& worst, bool pass) {
    return "{\"id\": \"" + id + "\", \"case\": \"case of " + id +
           "\", \"quantity\": \"q\", \"worst\": " + worst +
           ", \"bound\": 1, \"unit\": \"m\", \"pass\": " + (pass ? "true" : "false") + "}\n";
}

std::size_t rowsOf(const ReportSection& section) {
    std::size_t rows = 0;
    for (const ReportBlock& block : section.blocks)
        if (const auto* table = std::get_if<ReportTable>(&block)) rows += table->rows.size();
    return rows;
}

TEST(StabilityRows, BecomeATableAGroup) {
    const ReportSection section = stabilitySection(
        row("warp/a", "0.5", true) + "\n" + row("warp/b", "1", true) + row("flat", "0", true), "f");
    EXPECT_EQ(section.blocks.size(), 2u);
    EXPECT_EQ(rowsOf(section), 3u);
    EXPECT_THAT(section.text, HasSubstr("3 rows"));
    EXPECT_THAT(section.text, HasSubstr("all pass"));
}

TEST(StabilityRows, FailuresAreSaidAndNullIsNoNumber) {
    Report report;
    report.sections.push_back(stabilitySection(row("warp/a", "null", false), "f"));
    const std::string page = pageOf(report);
    EXPECT_EQ(test::xmlProblem(page), "");
    for (const char* words : {"1 FAIL", "case of warp/a", "<td>none</td>", "class=\"fail\""})
        EXPECT_THAT(page, HasSubstr(words));
}

TEST(StabilityRows, OfARowWrittenTwiceTheLaterCounts) {
    const ReportSection section = stabilitySection(row("a", "9", false) + row("a", "0", true), "f");
    EXPECT_EQ(rowsOf(section), 1u);
    EXPECT_THAT(section.text, HasSubstr("all pass"));
}

TEST(StabilityRows, NoneIsSaidWithWhatToDo) {
    for (const char* empty : {"", "\n", " \n\n"}) {
        Report report;
        report.sections.push_back(stabilitySection(empty, "f"));
        EXPECT_THAT(pageOf(report), HasSubstr("ninja -C build/release stability_rows"));
    }
}

TEST(StabilityRows, WhatIsNoRowIsNamedWithItsLine) {
    for (const char* bad : {"nonsense", "{}", "[]", "{\"id\": 3}", "{\"id\": \"a\"", "null"}) try {
            stabilitySection(row("a", "0", true) + bad, "rows.jsonl");
            ADD_FAILURE() << bad;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("rows.jsonl:2: expected a row")) << bad;
        }
}

}  // namespace
}  // namespace stereonav
