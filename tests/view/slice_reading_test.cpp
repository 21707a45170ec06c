// Slices that are read beside the window: after a cancel they can be read again; those of another study are
// not shown.
#include <gtest/gtest.h>

#include "app/view/loading.h"
#include "engine/base/error.h"
#include "tests/support/gate.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// Returns a study that is read until it is cancelled, or at once.
std::shared_ptr<const OpenScene> studyThatReads(bool forEver) {
    FakeParts parts;
    parts.readSlices = [forEver](Progress& progress) {
        test::waitFor([&] { return progress.report(0.5, "reading"), !forEver; });
        return std::make_shared<const SliceStudy>();
    };
    return opened(parts);
}

// Returns the final result of take(); throws its exceptions.
std::shared_ptr<const SliceStudy> outcomeOf(SliceReading& reading) {
    std::shared_ptr<const SliceStudy> study;
    EXPECT_TRUE(test::waitFor([&] { return (study = reading.take()) || !reading.busy(); }));
    return study;
}

TEST(SliceReading, IsCancelledAndBegunAgain) {
    SliceReading reading;
    reading.cancel();
    reading.start(studyThatReads(true), [] {});
    EXPECT_TRUE(reading.busy());
    EXPECT_EQ(reading.take(), nullptr);
    reading.cancel();
    EXPECT_THROW(outcomeOf(reading), Cancelled);
    EXPECT_FALSE(reading.busy());
    reading.start(studyThatReads(false), [] {});
    EXPECT_NE(outcomeOf(reading), nullptr);
}

TEST(SliceReading, OfTheStudyBeforeIsForgotten) {
    for (const bool forEver : {true, false}) {
        SliceReading reading;
        reading.start(studyThatReads(forEver), [] {});
        reading.abandon();
        EXPECT_EQ(outcomeOf(reading), nullptr);
        EXPECT_FALSE(reading.busy());
        reading.start(studyThatReads(false), [] {});
        EXPECT_NE(outcomeOf(reading), nullptr);
    }
}

// Cancelled or abandoned when nothing checks for it any more: the study that was read is not taken, not even
// for the study that is read next.
TEST(SliceReading, WhatComesAfterItWasGivenUpIsNotTaken) {
    for (const bool abandoned : {true, false}) {
        SCOPED_TRACE(abandoned);
        test::Gate gate;
        FakeParts parts;
        parts.readSlices = [&](Progress&) {
            gate.pass();
            return std::make_shared<const SliceStudy>();
        };
        SliceReading reading;
        reading.start(opened(parts), [] {});
        gate.await();
        abandoned ? reading.abandon() : reading.cancel();
        reading.start(studyThatReads(false), [] {});  // does nothing while it is busy
        gate.open();
        if (abandoned)
            EXPECT_EQ(outcomeOf(reading), nullptr);
        else
            EXPECT_THROW(outcomeOf(reading), Cancelled);
        EXPECT_FALSE(reading.busy());
        const auto next = std::make_shared<const SliceStudy>();
        parts.readSlices = [&](Progress&) { return next; };
        reading.start(opened(parts), [] {});
        EXPECT_EQ(outcomeOf(reading), next) << "and its own is told again";
    }
}

// A failure of a scene that is gone is not reported, either.
TEST(SliceReading, AFailureOfTheStudyBeforeIsNotTold) {
    for (const bool abandoned : {true, false}) {
        SCOPED_TRACE(abandoned);
        test::Gate gate;
        FakeParts parts;
        parts.readSlices = [&](Progress&) -> std::shared_ptr<const SliceStudy> {
            gate.pass();
            throw Error("a.nrrd", "", "is cut off", "copy it again");
        };
        SliceReading reading;
        reading.start(opened(parts), [] {});
        gate.await();
        if (abandoned) reading.abandon();
        gate.open();
        if (abandoned)
            EXPECT_EQ(outcomeOf(reading), nullptr);
        else
            EXPECT_THROW(outcomeOf(reading), Error);
    }
}

}  // namespace
}  // namespace stereonav
