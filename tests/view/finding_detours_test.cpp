// Changes of findings and back: what was removed comes back in its place, last first, and late measurements,
// searches and pages do not apply to anything that was changed meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/view/finding_list.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/gate.h"

namespace stereonav {
namespace {

// Findings are identified by x; those with a negative one can not be measured. Each measurement, search and
// page waits at the gate while it is closed, and is not told of its end.
class GatedFindings final : public Scene, public SurfaceFindings {
public:
    explicit GatedFindings(std::string named = "first") {
        Scene::name = std::move(named);
        offer<SurfaceFindings>(*this);
        gate.open();
    }
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
                            Progress&) const override {
        gate.pass();
        if (finding.asked.x < 0) throw Error("", "the place", "is left of 0", "take another");
        SurfaceFinding made = at(finding.asked, finding.comment);
        made.measured = made.found = true;
        made.diameter = finding.asked.x;
        made.lines = {Scene::name, study ? "values" : "none"};
        return made;
    }
    std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>&,
                                           Progress&) const override {
        gate.pass();
        return {at({50, 0, 0}, Scene::name)};
    }
    std::vector<std::string> notesOn(const FindingRefs& list) const override {
        return std::vector<std::string>(list.size());
    }
    std::string summaryOf(const FindingRefs& list) const override { return std::to_string(list.size()); }
    std::string notice() const override { return "a test"; }
    std::string documentOf(const FindingRefs& list) const override {
        std::string text;
        for (const SurfaceFinding* one : list)
            text += std::to_string(static_cast<int>(one->asked.x)) + " " + one->comment + ";";
        return text;
    }
    std::vector<SurfaceFinding> listOf(const std::string&, const std::filesystem::path&) const override {
        return {};
    }
    std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>&,
                       Progress&) const override {
        gate.pass();
        return "page of " + std::to_string(list.size());
    }
    std::string whyNoReport() const override { return ""; }
    std::string reportOf(const FindingRefs& list) const override {
        return "report of " + std::to_string(list.size());
    }

    mutable test::Gate gate;
};

class FindingDetours : public testing::Test {
protected:
    void settle(const std::shared_ptr<const SliceStudy>& study = nullptr) {
        EXPECT_TRUE(test::waitFor([&] { return !mList.poll(study) && !mList.busy(); }));
    }
    // Begins the next work, and waits until it is at the closed gate.
    void beginAtGate(const std::shared_ptr<const SliceStudy>& study = nullptr) {
        mScene->gate.close();
        const int before = mScene->gate.came();
        mList.poll(study);
        mScene->gate.await(before + 1);
    }
    int add(double x) {
        EXPECT_TRUE(mList.add({x, 0, 0}));
        return mList.rows().back().id;
    }
    std::vector<double> places() const {
        std::vector<double> all;
        for (const FindingList::Row& row : mList.rows()) all.push_back(row.finding.asked.x);
        return all;
    }
    int idOf(double x) const {
        for (const FindingList::Row& row : mList.rows())
            if (row.finding.asked.x == x) return row.id;
        return -1;
    }
    bool allMeasured() const {
        for (const FindingList::Row& row : mList.rows())
            if (!row.finding.measured || row.finding.diameter != row.finding.asked.x) return false;
        return true;
    }

    TemporaryFolder mFolder;
    std::filesystem::path mFile = mFolder / "findings/study.json";
    std::shared_ptr<GatedFindings> mScene = std::make_shared<GatedFindings>();
    FindingList mList{[] {}};
};

// Removed findings come back last first, at their places, however the list was changed meanwhile; the file
// always has the list's content.
TEST_F(FindingDetours, WhatWasRemovedComesBackLastFirst) {
    mList.open(mScene, mFile);
    std::mt19937 random(3);
    std::vector<double> plain;
    std::vector<std::pair<std::size_t, double>> removed;
    double next = 0;
    for (int n = 0; n < 120; ++n) {
        SCOPED_TRACE(n);
        const auto kind = random() % 5;
        if (kind < 2) {
            add(++next);
            plain.push_back(next);
        } else if (kind < 4 && !plain.empty()) {
            const std::size_t at = random() % plain.size();
            mList.remove(idOf(plain[at]));
            removed.emplace_back(at, plain[at]);
            plain.erase(plain.begin() + static_cast<std::ptrdiff_t>(at));
        } else {
            mList.putBack();
            if (!removed.empty()) {
                const std::size_t at = std::min(removed.back().first, plain.size());
                plain.insert(plain.begin() + static_cast<std::ptrdiff_t>(at), removed.back().second);
                removed.pop_back();
            }
        }
        ASSERT_EQ(places(), plain);
        ASSERT_EQ(mList.canPutBack(), !removed.empty());
        std::string document;
        for (const double x : plain) document += std::to_string(static_cast<int>(x)) + " ;";
        if (std::filesystem::exists(mFile)) {
            ASSERT_EQ(readTextFile(mFile), document);
        }
    }
    settle();
    EXPECT_TRUE(allMeasured());
}

// All removed and all restored: the same as before, with measurements, comments and numbers.
TEST_F(FindingDetours, AllRemovedAndPutBackIsAsItWas) {
    mList.open(mScene, mFile);
    for (const double x : {1, 2, 3, 4}) add(x);
    settle();
    mList.comment(idOf(3), "on a fold");
    const std::string before = readTextFile(mFile);
    std::vector<int> ids;
    for (const FindingList::Row& row : mList.rows()) ids.push_back(row.id);
    for (const double x : {2, 4, 1, 3}) mList.remove(idOf(x));
    EXPECT_TRUE(mList.rows().empty());
    EXPECT_EQ(mList.summary(), "");
    while (mList.canPutBack()) mList.putBack();
    EXPECT_EQ(readTextFile(mFile), before);
    std::vector<int> after;
    for (const FindingList::Row& row : mList.rows()) after.push_back(row.id);
    EXPECT_EQ(after, ids);
    EXPECT_TRUE(allMeasured());
    EXPECT_EQ(mList.summary(), "4");
    const int measurings = mScene->gate.came();
    settle();
    EXPECT_EQ(mScene->gate.came(), measurings) << "nothing is measured again";
}

// Nothing of one scene is restored into another.
TEST_F(FindingDetours, NothingIsPutBackIntoAnotherScene) {
    mList.open(mScene, mFile);
    mList.remove(add(1));
    ASSERT_TRUE(mList.canPutBack());
    mList.open(std::make_shared<GatedFindings>("other"), mFolder / "findings/other.json");
    EXPECT_FALSE(mList.canPutBack());
    mList.putBack();
    EXPECT_TRUE(mList.rows().empty());
    EXPECT_FALSE(std::filesystem::exists(mFolder / "findings/other.json"));
}

TEST_F(FindingDetours, RemovedWhileItIsMeasuredItIsMeasuredOncePutBack) {
    mList.open(mScene, mFile);
    const int id = add(1);
    add(2);
    beginAtGate();
    mList.remove(id);
    mScene->gate.open();
    settle();
    EXPECT_EQ(places(), (std::vector<double>{2}));
    EXPECT_TRUE(allMeasured());
    mList.putBack();
    settle();
    EXPECT_EQ(places(), (std::vector<double>{1, 2}));
    EXPECT_TRUE(allMeasured());
}

// A finding that is restored before its measurement is done gets it; another one in its place does not.
TEST_F(FindingDetours, AMeasuringIsOfTheFindingItWasBegunFor) {
    mList.open(mScene, mFile);
    const int id = add(1);
    beginAtGate();
    mList.remove(id);
    add(7);
    mList.putBack();
    mList.comment(id, "kept");
    mScene->gate.open();
    settle();
    EXPECT_EQ(places(), (std::vector<double>{1, 7}));
    EXPECT_TRUE(allMeasured()) << "each by its own place";
    EXPECT_EQ(mList.rows()[0].finding.comment, "kept");
}

// The values of a study that came during a measurement without it are added, and those of one that is gone
// are not asked for.
TEST_F(FindingDetours, AStudyThatComesMeanwhileIsToldOf) {
    const auto study = std::make_shared<const SliceStudy>();
    mList.open(mScene, mFile);
    add(1);
    beginAtGate();
    mScene->gate.open();
    settle(study);
    EXPECT_THAT(mList.rows()[0].finding.lines, testing::ElementsAre("first", "values"));
}

// Nothing of the scene before is taken: measurements, candidates, failures, or files.
TEST_F(FindingDetours, NothingOfTheSceneBeforeIsTaken) {
    const std::vector<std::pair<const char*, std::function<void()>>> works = {
        {"measured", [this] { add(1); }},
        {"failed", [this] { add(-1); }},
        {"candidates", [this] { mList.findCandidates(); }},
        {"page", [this] { mList.writePage(mFolder / "page.html"); }},
    };
    for (const auto& [name, begin] : works)
        for (const bool back : {false, true}) {
            SCOPED_TRACE(std::string(name) + (back ? ", there and back" : ""));
            std::filesystem::remove(mFile);
            mList.open(mScene, mFile);
            begin();
            beginAtGate();
            const auto other = std::make_shared<GatedFindings>("other");
            mList.open(other, "");
            if (back) mList.open(mScene, mFile);
            mScene->gate.open();
            settle();
            EXPECT_TRUE(mList.rows().empty());
            EXPECT_TRUE(mList.candidates().empty());
            EXPECT_EQ(mList.problem(), "");
            EXPECT_EQ(mList.told(), "");
            EXPECT_FALSE(mList.stopped());
            add(5);
            settle();
            EXPECT_EQ(mList.rows()[0].finding.lines.front(), back ? "first" : "other");
        }
}

// Another scene of the same file: measurements of it stay, and work goes on.
TEST_F(FindingDetours, AnotherSceneOfTheSameFileGoesOn) {
    mList.open(mScene, mFile);
    add(1);
    beginAtGate();
    const auto other = std::make_shared<GatedFindings>("other");
    mList.replaceScene(other);
    mScene->gate.open();
    settle();
    EXPECT_TRUE(allMeasured());
    add(2);
    settle();
    EXPECT_EQ(mList.rows()[1].finding.lines.front(), "other");
}

// After a cancel neither a late measurement nor candidates nor the page after it are taken.
TEST_F(FindingDetours, WhatWasCancelledIsDropped) {
    mList.open(mScene, mFile);
    add(1);
    beginAtGate();
    mList.findCandidates();
    mList.writePage(mFolder / "page.html");
    mList.cancel();
    mScene->gate.open();
    settle();
    EXPECT_FALSE(mList.rows()[0].finding.measured);
    EXPECT_TRUE(mList.candidates().empty());
    EXPECT_FALSE(std::filesystem::exists(mFolder / "page.html"));
    EXPECT_TRUE(mList.stopped());
    EXPECT_EQ(mList.told(), "cancelled");
    mList.use();
    settle();
    EXPECT_FALSE(mList.rows()[0].finding.measured) << "looked at it is not begun again";
    mList.findCandidates();
    beginAtGate();
    mList.cancel();
    mScene->gate.open();
    settle();
    EXPECT_TRUE(mList.candidates().empty());
    mList.goOn();
    settle();
    EXPECT_TRUE(allMeasured());
}

// A finding that is added before the cancel has taken effect: work goes on with both.
TEST_F(FindingDetours, TheNextFindingGoesOnThoughACancelIsStillToCome) {
    mList.open(mScene, mFile);
    add(1);
    beginAtGate();
    mList.cancel();
    add(2);
    mScene->gate.open();
    settle();
    EXPECT_FALSE(mList.stopped());
    EXPECT_TRUE(allMeasured());
    EXPECT_EQ(mList.rows().size(), 2u);
    // A later cancel takes effect.
    add(3);
    beginAtGate();
    mList.goOn();
    mList.cancel();
    mScene->gate.open();
    settle();
    EXPECT_TRUE(mList.stopped());
    EXPECT_FALSE(mList.rows()[2].finding.measured);
}

// A page that was begun has the list of that time.
TEST_F(FindingDetours, APageIsOfTheListThatItWasBegunFor) {
    mList.open(mScene, mFile);
    add(1);
    settle();
    mList.writePage(mFolder / "page.html");
    beginAtGate();
    add(2);
    mScene->gate.open();
    settle();
    EXPECT_EQ(readTextFile(mFolder / "page.html"), "page of 1");
    EXPECT_TRUE(allMeasured());
}

// A page is completed though another scene is opened: it is work that was asked for.
TEST_F(FindingDetours, APageOfTheSceneBeforeIsWrittenToItsEnd) {
    mList.open(mScene, mFile);
    add(1);
    settle();
    EXPECT_FALSE(mList.writes());
    mList.writePage(mFolder / "page.html");
    beginAtGate();
    EXPECT_TRUE(mList.writes()) << "which closing the window asks about";
    mList.open(std::make_shared<GatedFindings>("other"), "");
    mScene->gate.open();
    settle();
    EXPECT_FALSE(mList.writes());
    EXPECT_EQ(readTextFile(mFolder / "page.html"), "page of 1");
    EXPECT_EQ(mList.problem(), "");
}

// Candidates that are kept and removed again are removed findings, and not candidates.
TEST_F(FindingDetours, AKeptCandidateThatIsRemovedComesBackAsAFinding) {
    mList.open(mScene, mFile);
    mList.findCandidates();
    settle();
    ASSERT_EQ(mList.candidates().size(), 1u);
    const int id = mList.candidates()[0].id;
    mList.keep(id);
    mList.keep(id);
    EXPECT_EQ(mList.rows().size(), 1u);
    mList.remove(id);
    EXPECT_TRUE(mList.candidates().empty());
    mList.putBack();
    EXPECT_EQ(mList.rows()[0].id, id);
    EXPECT_TRUE(mList.candidates().empty());
}

}  // namespace
}  // namespace stereonav
