// Which instrument a click is for, the notice where there is nothing to measure, and whose study is asked
// for.
#include "app/view/instruments.h"

#include <gtest/gtest.h>

#include "tests/view/session_fixture.h"

namespace stereonav {
namespace {

class PictureInstruments : public SessionFixture {
protected:
    void begin() {
        mSession.emplace(opened(*mScene),
                         ViewSession::Options{OutputMode::SideBySide, std::nullopt, mFolder});
        mInstruments.open(mSession->open().scene, "");
    }

    std::optional<ViewSession> mSession;
    StudyReading mStudy{[] {}};
    Instruments mInstruments{mSession, mStudy, [] {}};
    AskedFrames mAsked;
};

TEST_F(PictureInstruments, BeforeASceneIsThereThereAreNone) {
    EXPECT_FALSE(mInstruments.measured() || mInstruments.coverage() || mInstruments.findings());
    mInstruments.measureAt(glm::dvec3(1));
    mInstruments.findAt(glm::dvec3(1));
    mInstruments.toggleCoverage(nullptr, mAsked);
    mInstruments.flyToUnseen(1);
    EXPECT_TRUE(mInstruments.line().places().empty());
    EXPECT_FALSE(mInstruments.painting());
}

TEST_F(PictureInstruments, AClickMeansOneThing) {
    begin();
    EXPECT_FALSE(mInstruments.takesClicks());
    mInstruments.measure(true);
    mInstruments.clickFindings(true);
    EXPECT_FALSE(mInstruments.measuring());
    EXPECT_TRUE(mInstruments.takesClicks());
    mInstruments.measure(true);
    EXPECT_FALSE(mInstruments.findingList().clicks());
}

TEST_F(PictureInstruments, TheSecondPlaceOfALineShowsItsPanel) {
    begin();
    mInstruments.measure(true);
    mInstruments.click(glm::dvec3(0, 0, 0));
    EXPECT_EQ(mInstruments.takeShows(), Instruments::Shows::Nothing);
    mInstruments.click(glm::dvec3(100, 0, 0));
    EXPECT_EQ(mInstruments.takeShows(), Instruments::Shows::Left);
    EXPECT_EQ(mInstruments.takeShows(), Instruments::Shows::Nothing);
    EXPECT_EQ(mInstruments.line().places().size(), 2u);
}

TEST_F(PictureInstruments, WhatCanNotBeMeasuredIsTold) {
    begin();
    mInstruments.measureAt(std::nullopt);
    EXPECT_EQ(mSession->notice(), "nothing is under the pointer");
    mInstruments.findAt(glm::dvec3(1));
    EXPECT_EQ(mSession->notice(), "findings are for colons");
    mInstruments.toggleCoverage(nullptr, mAsked);
    EXPECT_EQ(mSession->notice(), "coverage is for the wall of an opaque colon");
}

TEST_F(PictureInstruments, AStudyIsNotReadBeforeTheFirstPicture) {
    mScene->readSlices = [](Progress&) { return std::shared_ptr<const SliceStudy>(); };
    begin();
    EXPECT_FALSE(mStudy.wanted(*mSession));
    EXPECT_FALSE(mSession->slices().takeStudyWish());
    mStudy.noteFrame();
    EXPECT_FALSE(mStudy.wanted(*mSession));
    EXPECT_TRUE(mSession->slices().takeStudyWish());
}

}  // namespace
}  // namespace stereonav
