// Figures of a report as JSON and CSV, and what comparing two of them says.
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/report/json.h"
#include "app/report/page.h"
#include "engine/base/error.h"
#include "engine/image/inline_picture.h"
#include "tests/support/xml_check.h"

namespace stereonav {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Verdict = ReportChange::Verdict;
namespace fs = std::filesystem;

WayPoint point(const char* name, double time, double error, bool isDefault = false) {
    WayPoint p;
    p.way = {name, {time * 1.02, time, time * 1.1, 5}, error, isDefault};
    p.worstError = 2 * error;
    p.others = {{"holes %", 3}};
    return p;
}

Report reportWith(double time, double error) {
    Report report;
    report.machine = {{"processor", "a <fast> one & more"}};
    report.warnings = {"noisy \"today\""};
    ReportSection section{"part", "A part", "words", {}};
    WayChart chart;
    chart.id = "chart";
    chart.title = "Chart";
    chart.setting = "500x400";
    chart.points = {point("full", 10, 0), point("fast", time, error, true)};
    addChart(report, section, chart);
    section.blocks.emplace_back(ReportTable{"t", "x", {"a", "b"}, {{"1", "FAIL"}, {"<", "&"}}});
    section.blocks.emplace_back(ReportPictures{"p", "", {{"one", {1, 2, 3, 4}}}});
    section.blocks.emplace_back(ReportText{"text"});
    report.sections.push_back(section);
    return report;
}

EarlierReport asEarlier(const Report& report) {
    const fs::path file = fs::path(testing::TempDir()) / ("report_" + std::to_string(getpid()) + ".json");
    std::ofstream(file) << figuresJson(report);
    EarlierReport earlier = readEarlierReport(file);
    fs::remove(file);
    return earlier;
}

const ReportChange& changeOf(const ReportComparison& comparison, const std::string& id) {
    for (const ReportChange& c : comparison.changes)
        if (c.id == id) return c;
    throw std::runtime_error("no change of " + id);
}

TEST(ReportJson, ComesBackAsItWas) {
    const Report report = reportWith(2, 1);
    const EarlierReport back = asEarlier(report);
    ASSERT_EQ(back.figures.size(), report.figures.size());
    for (std::size_t n = 0; n < back.figures.size(); ++n) {
        EXPECT_EQ(back.figures[n].id, report.figures[n].id);
        EXPECT_EQ(back.figures[n].kind, report.figures[n].kind);
        EXPECT_EQ(back.figures[n].value.low, report.figures[n].value.low);
        EXPECT_EQ(back.figures[n].value.high, report.figures[n].value.high);
        EXPECT_EQ(back.figures[n].setting, report.figures[n].setting);
    }
    EXPECT_EQ(back.machine, report.machine);
}

TEST(ReportJson, RefusesWhatIsNoReport) {
    const fs::path file = fs::path(testing::TempDir()) / ("no_report_" + std::to_string(getpid()) + ".json");
    for (const char* content :
         {"", "[]", "{}", "{\"format\": \"stereonav report\", \"version\": 99}",
          "{\"format\": \"stereonav report\", \"version\": 1, \"quick\": false, \"machine\": {}, "
          "\"figures\": [{\"id\": 3}]}"}) {
        std::ofstream(file) << content;
        try {
            readEarlierReport(file);
            ADD_FAILURE() << content;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.filename().string())) << content;
            EXPECT_THAT(error.what(), HasSubstr("report.json")) << content;
        }
    }
    fs::remove(file);
    EXPECT_THROW(readEarlierReport(file), Error);
}

// An earlier report that somebody sent.
TEST(ReportJson, NeitherDepthNorManyNamesHoldItUp) {
    const fs::path file = fs::path(testing::TempDir()) / ("odd_report_" + std::to_string(getpid()) + ".json");
    const auto errorFor = [&](const std::string& machine) {
        std::ofstream(file)
            << "{\"format\": \"stereonav report\", \"version\": 1, \"quick\": false, \"machine\": " << machine
            << ", \"figures\": []}";
        try {
            readEarlierReport(file);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(errorFor(std::string(100000, '[') + std::string(100000, ']')), HasSubstr("at most 100 deep"));
    std::string names = "{\"a\": \"b\"";
    for (int n = 0; n < 300000; ++n) names += ",\"" + std::to_string(n) + "\":\"b\"";
    EXPECT_EQ(errorFor(names + "}"), "");
    fs::remove(file);
}

TEST(ReportJson, TheSameIdTwiceIsAMistake) {
    Report report;
    addFigure(report, {"a", "", "", ReportFigure::Kind::Time, exactly(1)});
    EXPECT_THROW(addFigure(report, {"a", "", "", ReportFigure::Kind::Time, exactly(1)}), Error);
}

TEST(ReportCsv, HasALineAFigure) {
    const Report report = reportWith(2, 1);
    const std::string csv = figuresCsv(report);
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), report.figures.size() + 1);
    EXPECT_THAT(csv, HasSubstr("\"chart/fast/time\",time,2.04,2,2.2,5,"));
}

TEST(ReportComparison, NothingMovedIsNotWorse) {
    const Report report = reportWith(2, 1);
    const ReportComparison comparison = compareReports(asEarlier(report), report);
    EXPECT_EQ(comparison.changes.size(), 4u);  // time and error of two ways
    for (const ReportChange& c : comparison.changes) EXPECT_EQ(c.verdict, Verdict::Same) << c.id;
    EXPECT_FALSE(comparison.worse());
    EXPECT_TRUE(comparison.gone.empty());
    EXPECT_TRUE(comparison.added.empty());
}

TEST(ReportComparison, CatchesSlowerAndWorse) {
    const EarlierReport before = asEarlier(reportWith(2, 1));
    const ReportComparison slow = compareReports(before, reportWith(3, 1)),
                           wrong = compareReports(before, reportWith(2, 1.1));
    EXPECT_TRUE(slow.worse());
    EXPECT_EQ(changeOf(slow, "chart/fast/time").verdict, Verdict::Worse);
    EXPECT_EQ(changeOf(slow, "chart/fast/error").verdict, Verdict::Same);
    EXPECT_EQ(slow.changes.front().id, "chart/fast/time");
    EXPECT_TRUE(wrong.worse());
    EXPECT_EQ(changeOf(wrong, "chart/fast/error").verdict, Verdict::Worse);
    const ReportComparison better = compareReports(before, reportWith(1, 0.5));
    EXPECT_FALSE(better.worse());
    EXPECT_EQ(changeOf(better, "chart/fast/time").verdict, Verdict::Better);
    EXPECT_EQ(changeOf(better, "chart/fast/error").verdict, Verdict::Better);
}

TEST(ReportComparison, WhatIsWithinTheSpreadIsTheSame) {
    EXPECT_FALSE(compareReports(asEarlier(reportWith(2, 1)), reportWith(2.2, 1.01)).worse());
    // a moody machine allows for more
    Report before = reportWith(2, 1), after = reportWith(3, 1);
    addFigure(before, {kMoodFigure, "ms", "", ReportFigure::Kind::Time, {1, 0.8, 1.8, 5}});
    addFigure(after, {kMoodFigure, "ms", "", ReportFigure::Kind::Time, exactly(9)});
    EXPECT_FALSE(compareReports(asEarlier(before), after).worse());
}

TEST(ReportComparison, FewRepeatsAllowForMore) {
    Report before, after;
    for (const int count : {2, 3}) {
        const std::string id = "repeats " + std::to_string(count);
        addFigure(before, {id, "ms", "", ReportFigure::Kind::Time, {1, 1, 1, count}});
        addFigure(after, {id, "ms", "", ReportFigure::Kind::Time, {1.25, 1.25, 1.25, count}});
    }
    const ReportComparison comparison = compareReports(asEarlier(before), after);
    EXPECT_EQ(changeOf(comparison, "repeats 2").verdict, Verdict::Same);
    EXPECT_EQ(changeOf(comparison, "repeats 3").verdict, Verdict::Worse);
}

TEST(ReportComparison, FromNoErrorToSomeIsWorse) {
    EXPECT_TRUE(compareReports(asEarlier(reportWith(2, 0)), reportWith(2, 0.1)).worse());
    EXPECT_FALSE(compareReports(asEarlier(reportWith(2, 0)), reportWith(2, 0)).worse());
}

TEST(ReportComparison, OtherSettingsAreNotCompared) {
    Report before = reportWith(2, 1), after = reportWith(20, 10);
    after.quick = true;
    const ReportComparison comparison = compareReports(asEarlier(before), after);
    EXPECT_TRUE(comparison.changes.empty());
    EXPECT_EQ(comparison.otherwise.size(), 4u);
    EXPECT_FALSE(comparison.worse());
}

TEST(ReportComparison, TellsWhatOnlyOneHas) {
    Report before = reportWith(2, 1), after = reportWith(2, 1);
    addFigure(before, {"old", "", "", ReportFigure::Kind::Error, exactly(1)});
    addFigure(after, {"new", "", "", ReportFigure::Kind::Time, exactly(1)});
    const ReportComparison comparison = compareReports(asEarlier(before), after);
    EXPECT_THAT(comparison.gone, ElementsAre("old"));
    EXPECT_THAT(comparison.added, ElementsAre("new"));
}

TEST(ReportPage, IsWellFormedAndSelfContained) {
    Report report = reportWith(2, 1);
    const EarlierReport before = asEarlier(reportWith(1, 1));
    report.sections.push_back(comparisonSection(compareReports(before, report), before, "old.json"));
    const std::string page = pageOf(report);
    EXPECT_EQ(test::xmlProblem(page), "");
    EXPECT_THAT(page, HasSubstr("chart/fast/time"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,AQIDBA=="));
    EXPECT_THAT(page, HasSubstr("a &lt;fast&gt; one &amp; more"));
    for (const char* outside : {"src=\"http", "href=\"http", "<script", "<link", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(ReportPage, NamesTheFrontAndTheDefault) {
    EXPECT_THAT(pageOf(reportWith(2, 1)),
                HasSubstr("from the fastest: fast, full. The default, fast, is on the front."));
    EXPECT_THAT(pageOf(reportWith(20, 1)),
                HasSubstr("The default, fast, is not on the front: full takes 50.0 % less"));
}

TEST(ReportPage, SaysWhyOfADefaultThatIsBeatenAlone) {
    for (const bool beaten : {true, false}) {
        Report report = reportWith(beaten ? 20 : 2, 1);
        std::get<WayChart>(report.sections[0].blocks[0]).why = "because of this";
        EXPECT_EQ(pageOf(report).find("because of this") != std::string::npos, beaten);
    }
}

TEST(ReportPage, AnEmptyReportIsAPageToo) {
    EXPECT_EQ(test::xmlProblem(pageOf({})), "");
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, coded] : vectors) {
        const std::string text = plain;
        const std::vector<unsigned char> bytes(text.begin(), text.end());
        EXPECT_EQ(base64(bytes), coded);
    }
}

}  // namespace
}  // namespace stereonav
