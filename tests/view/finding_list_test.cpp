// The window's list of findings: what of it is kept and when, measurements beside it, candidates and pages.
#include "app/view/finding_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "app/output/eye_marks.h"
#include "app/view/finding_marks.h"
#include "app/view/frame_views.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

// A scene with its own kind of findings: places with x above 0 are something, one at x = 9 can not be
// measured, and one within 1 of another is the same.
class FindingScene final : public Scene, public SurfaceFindings {
public:
    FindingScene() { offer<SurfaceFindings>(*this); }
    FrameMaker& frames() const override { throw Error("", "", "no frames", ""); }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }

    SurfaceFinding at(const glm::dvec3& place, const std::string& comment) const override {
        SurfaceFinding finding;
        finding.asked = place;
        finding.comment = comment;
        finding.own = std::make_shared<SurfaceFinding::Own>();
        return finding;
    }
    SurfaceFinding measured(const SurfaceFinding& finding, const std::shared_ptr<const SliceStudy>& study,
                            Progress& progress) const override {
        ++measurings;
        test::waitFor([&] { return !waits || (progress.report(0.5, "waiting"), false); });
        if (finding.asked.x == 9) throw Error("", "the place", "has x = 9", "take another");
        SurfaceFinding made = at(finding.asked, finding.comment);
        made.measured = true;
        made.found = finding.asked.x > 0;
        made.note = made.found ? "" : "nothing there";
        made.diameter = 1e-3 * finding.asked.x;
        made.outline = {finding.asked + glm::dvec3(0, 0, 2), finding.asked - glm::dvec3(0, 0, 2)};
        made.across = {finding.asked};
        if (study) made.lines = {"values"};
        return made;
    }
    std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>& study,
                                           Progress& progress) const override {
        return {measured(at({5, 0, 0}, "candidate 1"), study, progress)};
    }
    std::vector<std::string> notesOn(const FindingRefs& list) const override {
        std::vector<std::string> notes;
        for (std::size_t b = 0; b < list.size(); ++b) {
            notes.push_back(list[b]->note);
            for (std::size_t a = 0; a < b; ++a)
                if (glm::distance(list[a]->asked, list[b]->asked) < 1) notes.back() = "a double";
        }
        return notes;
    }
    std::string summaryOf(const FindingRefs& list) const override { return std::to_string(list.size()); }
    std::string notice() const override { return "a test"; }
    // Returns a line for each.
    std::string documentOf(const FindingRefs& list) const override {
        std::string text = "list\n";
        for (const SurfaceFinding* one : list)
            text += std::to_string(one->asked.x) + " " + one->comment + "\n";
        return text;
    }
    std::vector<SurfaceFinding> listOf(const std::string& document,
                                       const std::filesystem::path& file) const override {
        if (!document.starts_with("list\n")) throw Error(file.string(), "", "is no list", "move it away");
        std::istringstream in(document.substr(5));
        std::vector<SurfaceFinding> list;
        for (std::string line; std::getline(in, line);) {
            const std::size_t blank = line.find(' ');
            list.push_back(at({std::stod(line.substr(0, blank)), 0, 0}, line.substr(blank + 1)));
        }
        return list;
    }
    std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>&,
                       Progress&) const override {
        return "page of " + std::to_string(list.size());
    }

    std::string whyNoReport() const override { return noReport; }
    std::string reportOf(const FindingRefs& list) const override {
        return "report of " + std::to_string(list.size());
    }

    std::string noReport;
    mutable std::atomic<int> measurings = 0;
    std::atomic<bool> waits = false;
};

class FindingListTest : public testing::Test {
protected:
    void settle(FindingList& list, const std::shared_ptr<const SliceStudy>& study = nullptr) {
        EXPECT_TRUE(test::waitFor([&] { return !list.poll(study) && !list.busy(); }));
    }
    TemporaryFolder mFolder;
    std::filesystem::path mFile = mFolder / "findings/study.json";
    std::shared_ptr<FindingScene> mScene = std::make_shared<FindingScene>();
    FindingList mList{[] {}};
};

TEST_F(FindingListTest, CostsNothingBeforeItIsUsed) {
    mList.open(mScene, mFile);
    settle(mList);
    EXPECT_EQ(mScene->measurings, 0);
    EXPECT_FALSE(std::filesystem::exists(mFile));
    mList.add({3, 0, 0});
    settle(mList);
    EXPECT_EQ(mScene->measurings, 1);
    // Kept findings are not measured, either, until the list is in use.
    FindingList again([] {});
    again.open(mScene, mFile);
    settle(again);
    ASSERT_EQ(again.rows().size(), 1u);
    EXPECT_FALSE(again.rows()[0].finding.measured);
    EXPECT_EQ(mScene->measurings, 1);
    again.use();
    settle(again);
    EXPECT_TRUE(again.rows()[0].finding.measured);
    EXPECT_EQ(mScene->measurings, 2);
}

TEST_F(FindingListTest, IsKeptAsItIsMade) {
    mList.open(mScene, mFile);
    mScene->waits = true;
    mList.add({3, 0, 0});
    EXPECT_EQ(readTextFile(mFile), "list\n3.000000 \n") << "before it is measured: a crash loses nothing";
    mList.poll(nullptr);
    mList.comment(mList.rows()[0].id, "on a\nfold");  // while the finding is measured
    mScene->waits = false;
    settle(mList);
    EXPECT_EQ(readTextFile(mFile), "list\n3.000000 on a fold\n");
    EXPECT_EQ(mList.rows()[0].finding.comment, "on a fold");
    EXPECT_EQ(mList.summary(), "1");
    mList.add({-1, 0, 0});
    mList.add({3.5, 0, 0});
    settle(mList);
    EXPECT_EQ(mList.rows()[1].note, "nothing there");
    EXPECT_EQ(mList.rows()[2].note, "a double");
    mList.remove(mList.rows()[0].id);
    EXPECT_EQ(mList.rows()[1].note, "") << "its double is gone";
    EXPECT_EQ(readTextFile(mFile), "list\n-1.000000 \n3.500000 \n");
    mList.putBack();
    EXPECT_FALSE(mList.canPutBack());
    EXPECT_EQ(readTextFile(mFile), "list\n3.000000 on a fold\n-1.000000 \n3.500000 \n");
    EXPECT_EQ(mList.rows()[2].note, "a double");
}

TEST_F(FindingListTest, ValuesComeWithTheStudy) {
    mList.open(mScene, mFile);
    mList.add({3, 0, 0});
    settle(mList);
    EXPECT_TRUE(mList.rows()[0].finding.lines.empty());
    settle(mList, std::make_shared<SliceStudy>());
    EXPECT_THAT(mList.rows()[0].finding.lines, testing::ElementsAre("values"));
    EXPECT_EQ(mScene->measurings, 2) << "once again, and no more";
}

TEST_F(FindingListTest, WhatFailsStopsUntilItIsAskedForAgain) {
    mList.open(mScene, mFile);
    mList.add({9, 0, 0});
    settle(mList);
    EXPECT_THAT(mList.problem(), testing::HasSubstr("has x = 9"));
    EXPECT_TRUE(mList.stopped());
    mList.use();
    settle(mList);
    EXPECT_EQ(mScene->measurings, 1);
    mList.remove(mList.rows()[0].id);
    mScene->waits = true;
    mList.add({2, 0, 0});
    mList.poll(nullptr);
    EXPECT_TRUE(mList.busy());
    mList.cancel();
    settle(mList);
    EXPECT_TRUE(mList.stopped());
    EXPECT_FALSE(mList.rows()[0].finding.measured);
    mScene->waits = false;
    mList.goOn();
    settle(mList);
    EXPECT_TRUE(mList.rows()[0].finding.measured);
    // Unfinished work ends with its list.
    mScene->waits = true;
    mList.add({4, 0, 0});
    mList.poll(nullptr);
}

TEST_F(FindingListTest, OfAnotherSceneNothingIsTaken) {
    mList.open(mScene, mFile);
    mScene->waits = true;
    mList.add({3, 0, 0});
    mList.poll(nullptr);
    const auto other = std::make_shared<FindingScene>();
    mList.open(other, "");
    mScene->waits = false;
    settle(mList);
    EXPECT_TRUE(mList.rows().empty());
    EXPECT_EQ(mList.problem(), "");
    mList.add({1, 0, 0});
    EXPECT_EQ(readTextFile(mFile), "list\n3.000000 \n") << "another scene's";
    class Plain final : public Scene {
        FrameMaker& frames() const override { throw Error("", "", "no frames", ""); }
        std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    };
    mList.open(std::make_shared<Plain>(), mFile);
    EXPECT_FALSE(mList.maker());
    EXPECT_FALSE(mList.add({1, 0, 0}));
}

TEST_F(FindingListTest, CandidatesAreKeptApart) {
    mList.open(mScene, mFile);
    mList.findCandidates();
    settle(mList);
    ASSERT_EQ(mList.candidates().size(), 1u);
    EXPECT_EQ(mList.candidates()[0].note, "");
    EXPECT_TRUE(mList.rows().empty());
    EXPECT_FALSE(std::filesystem::exists(mFile));
    mList.keep(mList.candidates()[0].id);
    EXPECT_TRUE(mList.candidates().empty());
    EXPECT_EQ(readTextFile(mFile), "list\n5.000000 candidate 1\n");
    settle(mList);
    EXPECT_EQ(mScene->measurings, 1) << "it is measured already";
    mList.findCandidates();
    settle(mList);
    EXPECT_EQ(mList.candidates()[0].note, "a double") << "it is a finding now";
}

// Points and a number are drawn where both eyes see them, findings in another colour than candidates; nothing
// that is hidden.
TEST_F(FindingListTest, IsMarkedInBothEyes) {
    mList.open(mScene, mFile);
    FrameRequest request;
    request.pose = poseFromAngles({0, 0, 0}, 0, 0, 0);
    request.lens.width = 200, request.lens.height = 100;
    request.stereo = {1, 50};
    const StereoViews views = viewsOf(request);
    const glm::dvec3 place = views.left.pointAt(100, 50, 40);
    ASSERT_GT(place.y, 39);
    const auto marksBefore = [&](float depth) {
        Plane<float> seen(200, 100);
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 200; ++x) seen.at(x, y) = depth;
        std::vector<OverlayMark> marks;
        addFindingMarks(mList, request, seen, {0, 0}, 10, marks);
        return marks;
    };
    EXPECT_TRUE(marksBefore(100).empty());
    mList.add(place);
    EXPECT_EQ(marksBefore(100).size(), 1u) << "its number, before it is measured";
    settle(mList);
    const std::vector<OverlayMark> marks = marksBefore(40);
    ASSERT_EQ(marks.size(), 4u);
    const OverlayMark& label = marks.back();
    EXPECT_EQ(label.text, "1");
    EXPECT_NEAR(label.left.x, views.left.project(place).x, 0.1);
    EXPECT_NEAR(label.right.x, views.right.project(place).x, 0.1);
    EXPECT_GT(std::abs(label.left.x - label.right.x), 0.2f) << "at its depth";
    EXPECT_TRUE(marks[0].dot && marks[1].dot);
    EXPECT_LT(marks[0].left.y, marks[1].left.y);
    EXPECT_TRUE(marksBefore(20).empty()) << "behind what is seen";
    mList.remove(mList.rows()[0].id);
    mList.findCandidates();
    settle(mList);
    EXPECT_TRUE(marksBefore(100).empty()) << "that one lies beside the picture";
}

TEST_F(FindingListTest, APageIsWritten) {
    mList.open(mScene, mFile);
    mList.add({3, 0, 0});
    EXPECT_THROW(mList.writePage(mFolder / "page.txt"), Error);
    EXPECT_THROW(mList.writePage(mFolder / "none/page.html"), Error);
    mList.writePage(mFolder / "page.html");
    settle(mList);
    EXPECT_EQ(readTextFile(mFolder / "page.html"), "page of 1");
    EXPECT_THAT(mList.told(), testing::HasSubstr("page.html"));
}

TEST_F(FindingListTest, FilesThatAreThereStay) {
    mList.open(mScene, mFile);
    mList.add({3, 0, 0});
    settle(mList);
    for (const char* const name : {"page.html", "report.dcm"})
        std::ofstream(mFolder / name) << "of another scene";
    for (const char* const number : {"_0002", "_0003"}) {
        mList.writePage(mFolder / "page.html");
        settle(mList);
        EXPECT_THAT(mList.told(), testing::HasSubstr(std::string("page") + number + ".html"));
        EXPECT_EQ(readTextFile(mFolder / (std::string("page") + number + ".html")), "page of 1");
        mList.writeReport(mFolder / "report.dcm");
        settle(mList);
        EXPECT_EQ(readTextFile(mFolder / (std::string("report") + number + ".dcm")), "report of 1");
    }
    for (const char* const name : {"page.html", "report.dcm"})
        EXPECT_EQ(readTextFile(mFolder / name), "of another scene");
}

TEST_F(FindingListTest, AReportIsWrittenOfWhatIsMeasured) {
    const std::filesystem::path file = mFolder / "report.dcm";
    mList.open(mScene, mFile);
    mList.add({3, 0, 0});
    EXPECT_THROW(mList.writeReport(file), Error) << "nothing is measured yet";
    settle(mList);
    EXPECT_THROW(mList.writeReport(mFolder / "report.txt"), Error);
    EXPECT_THROW(mList.writeReport(mFolder / "none/report.dcm"), Error);
    mScene->noReport = "it is no study";
    try {
        mList.writeReport(file);
        ADD_FAILURE() << "expected an error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("it is no study"));
    }
    settle(mList);
    EXPECT_FALSE(std::filesystem::exists(file));
    mScene->noReport.clear();
    mList.writePage(mFolder / "page.html");
    mList.writeReport(file);
    settle(mList);
    EXPECT_EQ(readTextFile(mFolder / "page.html"), "page of 1") << "one after the other";
    EXPECT_EQ(readTextFile(file), "report of 1");
    EXPECT_THAT(mList.told(), testing::HasSubstr("report.dcm"));
    // No page is written for a scene that is gone.
    std::filesystem::remove(file);
    mList.writeReport(file);
    mList.open(mScene, mFolder / "findings/other.json");
    settle(mList);
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_THAT(mList.problem(), testing::HasSubstr("report.dcm was not written"));
}

TEST_F(FindingListTest, ADamagedFileIsSetAside) {
    std::filesystem::create_directories(mFile.parent_path());
    std::ofstream(mFile) << "{";
    mList.open(mScene, mFile);
    EXPECT_THAT(mList.problem(), testing::HasSubstr("is no list"));
    EXPECT_TRUE(std::filesystem::exists(mFile.string() + ".damaged"));
    mList.add({3, 0, 0});
    EXPECT_EQ(readTextFile(mFile), "list\n3.000000 \n");
}

}  // namespace
}  // namespace stereonav
