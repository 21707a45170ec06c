// Every stack for undo and redo, compared action by action with a plain list of states: another change drops
// the states ahead, the bottom is the beginning, and the top is the end. The number of kept steps is limited.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/view/keyframe_edit.h"
#include "app/view/settings_history.h"
#include "engine/base/error.h"
#include "tests/support/plain_steps.h"

namespace stereonav {
namespace {

using test::PlainSteps;

SettingTexts settingsNumbered(int n) {
    return {{"fov", {std::to_string(n)}}};
}

class SettingSteps : public testing::Test {
protected:
    SettingSteps() { mHistory.start(mPlain.now()); }

    void rest() { mHistory.observe(mPlain.now(), false, 1); }
    // Sets without coming to rest.
    void set(const SettingTexts& settings) {
        mHistory.observe(settings, false, 0.1);
        if (settings != mPlain.now()) mPlain.change(settings);
    }
    void drag(int from, int to) {
        for (int n = from; n != to; n += n < to ? 1 : -1) mHistory.observe(settingsNumbered(n), true, 5);
        set(settingsNumbered(to));
    }
    void undo() {
        const auto to = mHistory.undo();
        ASSERT_EQ(to.has_value(), mPlain.canUndo());
        mPlain.undo();
        if (to) {
            ASSERT_EQ(*to, mPlain.now());
        }
        rest();
    }
    void redo() {
        const auto to = mHistory.redo();
        ASSERT_EQ(to.has_value(), mPlain.canRedo());
        mPlain.redo();
        if (to) {
            ASSERT_EQ(*to, mPlain.now());
        }
        rest();
    }
    void expectSame() const {
        ASSERT_EQ(mHistory.canUndo(), mPlain.canUndo());
        ASSERT_EQ(mHistory.canRedo(), mPlain.canRedo());
    }

    PlainSteps<SettingTexts> mPlain{settingsNumbered(0)};
    SettingsHistory mHistory;
};

TEST_F(SettingSteps, AreThoseOfAPlainList) {
    std::mt19937 random(1);
    int number = 0;
    for (int n = 0; n < 400; ++n) {
        SCOPED_TRACE(n);
        switch (random() % 6) {
            case 0:
                set(settingsNumbered(++number));
                random() % 2 ? rest() : undo();  // a state that is passed is no step, but undo starts from it
                break;
            case 1:
                drag(number + 1, number + 4);
                number += 4;
                rest();
                break;
            case 2:
                redo();
                break;
            default:
                undo();
        }
        expectSame();
        if (HasFatalFailure()) return;
    }
}

TEST_F(SettingSteps, ADetourLeavesNothingAhead) {
    for (const int n : {1, 2, 3}) set(settingsNumbered(n)), rest();
    undo(), undo();
    set(settingsNumbered(9)), rest();
    expectSame();
    redo();
    undo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(1)) << "what was passed over is not between them";
    expectSame();
    redo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(9));
}

// Set by hand to the next step: it is another way all the same.
TEST_F(SettingSteps, TheSameSettingsAgainAreAnotherWay) {
    for (const int n : {1, 2, 3}) set(settingsNumbered(n)), rest();
    undo(), undo();
    set(settingsNumbered(2)), rest();
    expectSame();
    undo(), undo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(0));
    redo(), redo(), redo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(2));
}

TEST_F(SettingSteps, FromTheBottomToTheTop) {
    for (int n = 1; n <= 20; ++n) set(settingsNumbered(n)), rest();
    for (int n = 0; n < 25; ++n) undo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(0));
    expectSame();
    for (int n = 0; n < 25; ++n) redo();
    EXPECT_EQ(mPlain.now(), settingsNumbered(20));
    expectSame();
}

TEST_F(SettingSteps, TheOldestAreDroppedBeyondFiveHundred) {
    for (int n = 1; n <= 700; ++n) set(settingsNumbered(n)), rest();
    int back = 0;
    std::optional<SettingTexts> bottom;
    while (auto to = mHistory.undo()) {
        bottom = to;
        mHistory.observe(*to, false, 1);
        ++back;
        ASSERT_EQ(*to, settingsNumbered(700 - back));
    }
    EXPECT_EQ(back, 499);
    for (int n = 0; n < back; ++n) {
        const auto to = mHistory.redo();
        ASSERT_TRUE(to);
        ASSERT_EQ(*to, settingsNumbered(700 - back + n + 1));
        mHistory.observe(*to, false, 1);
    }
    EXPECT_FALSE(mHistory.canRedo());
}

TEST_F(SettingSteps, AnotherSceneBeginsAnew) {
    for (const int n : {1, 2, 3}) set(settingsNumbered(n)), rest();
    undo();
    mHistory.observe(settingsNumbered(7), false, 0.1);  // not at rest when the other scene is there
    mHistory.start(settingsNumbered(50));
    EXPECT_FALSE(mHistory.canUndo());
    EXPECT_FALSE(mHistory.canRedo());
    EXPECT_FALSE(mHistory.undo());
    EXPECT_FALSE(mHistory.redo());
}

// Keyframes are compared by places and times: their number alone would be no test.
using KeysSeen = std::vector<std::pair<double, glm::dvec3>>;

KeysSeen seenOf(const Keyframes& keys) {
    KeysSeen seen;
    for (const PathSample& key : keys) seen.emplace_back(key.time, key.pose.position);
    return seen;
}

Keyframes keysInARow(int count) {
    std::vector<Pose> poses;
    for (int n = 0; n < count; ++n) poses.push_back(poseFromAngles({100.0 * n, 0, 50}, 1.5, 0, 0));
    return timedKeyframes(poses, 100);
}

class KeyframeSteps : public testing::Test {
protected:
    KeyframeSteps() { mEdit.start(keysInARow(4)); }

    void took() { mPlain.change(seenOf(mEdit.keys())); }
    void add() {
        mEdit.add(poseFromAngles({37.0 * ++mNumber, 10, 60}, 1, 0, 0), 100);
        took();
    }
    void remove(std::size_t key) {
        mEdit.choose(key);
        if (!mEdit.chosen()) return;
        mEdit.removeChosen();
        took();
    }
    void drag(std::size_t key) {
        if (key >= mEdit.keys().size()) return;
        mEdit.beginDrag(key);
        for (int n = 0; n < 3; ++n) mEdit.dragTo({1000.0 + ++mNumber, 5.0 * n, 80});
        mEdit.endDrag();
        took();
    }
    void undo() { mEdit.undo(), mPlain.undo(); }
    void redo() { mEdit.redo(), mPlain.redo(); }
    void expectSame() const {
        ASSERT_EQ(seenOf(mEdit.keys()), mPlain.now());
        ASSERT_EQ(mEdit.canUndo(), mPlain.canUndo());
        ASSERT_EQ(mEdit.canRedo(), mPlain.canRedo());
        if (mEdit.chosen()) {
            ASSERT_LT(*mEdit.chosen(), mEdit.keys().size());
        }
    }

    int mNumber = 0;
    KeyframeEdit mEdit;
    PlainSteps<KeysSeen> mPlain{seenOf(keysInARow(4))};
};

TEST_F(KeyframeSteps, AreThoseOfAPlainList) {
    std::mt19937 random(2);
    for (int n = 0; n < 180; ++n) {
        SCOPED_TRACE(n);
        const long long version = mEdit.version();
        const KeysSeen before = mPlain.now();
        switch (random() % 7) {
            case 0:
                add();
                break;
            case 1:
                remove(random() % 5);
                break;
            case 2:
                drag(random() % 5);
                break;
            case 3:
                redo();
                break;
            default:
                undo();
        }
        expectSame();
        if (HasFatalFailure()) return;
        if (mPlain.now() != before) {
            ASSERT_GT(mEdit.version(), version) << "who draws them is told";
        }
    }
}

TEST_F(KeyframeSteps, EachKindOfChangeLeavesNothingAhead) {
    const std::vector<std::function<void()>> changes = {[this] { add(); }, [this] { remove(1); },
                                                        [this] { drag(2); }};
    for (std::size_t n = 0; n < changes.size(); ++n) {
        SCOPED_TRACE(n);
        drag(0), add(), drag(1);
        undo(), undo();
        ASSERT_TRUE(mEdit.canRedo());
        changes[n]();
        expectSame();
        EXPECT_FALSE(mEdit.canRedo());
        redo();
        expectSame();
        undo();
        expectSame();
    }
}

TEST_F(KeyframeSteps, FromTheBottomToTheTop) {
    const KeysSeen bottom = seenOf(mEdit.keys());
    for (int n = 0; n < 8; ++n) add(), drag(1), remove(2);
    const KeysSeen top = seenOf(mEdit.keys());
    for (int n = 0; n < 30; ++n) undo();
    EXPECT_EQ(seenOf(mEdit.keys()), bottom);
    EXPECT_FALSE(mEdit.canUndo());
    for (int n = 0; n < 30; ++n) redo();
    EXPECT_EQ(seenOf(mEdit.keys()), top);
    EXPECT_FALSE(mEdit.canRedo());
}

TEST_F(KeyframeSteps, TheOldestAreDroppedBeyondTwoHundred) {
    for (int n = 0; n < 230; ++n) drag(1);
    int back = 0;
    while (mEdit.canUndo()) {
        undo();
        ++back;
        ASSERT_EQ(seenOf(mEdit.keys()), mPlain.now());
    }
    EXPECT_EQ(back, 200);
}

// An undo during a drag: the drag is dropped, and what comes after it is as after any step.
TEST_F(KeyframeSteps, AStepWithinADragDropsIt) {
    drag(1);
    mEdit.beginDrag(2);
    mEdit.dragTo({5, 5, 5});
    undo();
    expectSame();
    EXPECT_FALSE(mEdit.dragging());
    mEdit.dragTo({6, 6, 6});
    mEdit.endDrag();
    expectSame();
    redo();
    expectSame();
    undo();
    mEdit.beginDrag(2);
    mEdit.dragTo({7, 7, 7});
    redo();
    expectSame();
    mEdit.endDrag();
    expectSame();
}

// Delete, a key for another one, or another handle during a drag: the drag ends first, as a step.
TEST_F(KeyframeSteps, AChangeWithinADragComesAfterIt) {
    const std::vector<std::function<void()>> changes = {
        [this] { add(); }, [this] { mEdit.removeChosen(), took(); },
        [this] {
            mEdit.beginDrag(3), mEdit.dragTo({1, 2, 3}), mEdit.endDrag(), took();
        }};
    for (std::size_t n = 0; n < changes.size(); ++n) {
        SCOPED_TRACE(n);
        const KeysSeen bottom = seenOf(mEdit.keys());
        mEdit.beginDrag(1);
        mEdit.dragTo({700, 800 + 10.0 * static_cast<double>(n), 50});
        took();  // place of the pointer
        changes[n]();
        EXPECT_FALSE(mEdit.dragging());
        expectSame();
        undo();
        expectSame();
        undo();
        expectSame();
        EXPECT_EQ(seenOf(mEdit.keys()), bottom);
    }
}

TEST_F(KeyframeSteps, OtherKeyframesBeginAnew) {
    drag(1), add();
    undo();
    mEdit.beginDrag(0);
    mEdit.start(keysInARow(2));
    EXPECT_FALSE(mEdit.canUndo());
    EXPECT_FALSE(mEdit.canRedo());
    EXPECT_FALSE(mEdit.dragging());
    EXPECT_FALSE(mEdit.chosen());
    mEdit.undo(), mEdit.redo(), mEdit.endDrag();
    EXPECT_EQ(seenOf(mEdit.keys()), seenOf(keysInARow(2)));
}

// A keyframe that can not be added is no step, and the steps ahead stay.
TEST_F(KeyframeSteps, WhatFailsIsNoStep) {
    drag(1);
    undo();
    Pose nowhere;
    nowhere.position.x = std::nan("");
    EXPECT_THROW(mEdit.add(nowhere, 100), Error);
    mEdit.choose(std::nullopt);
    mEdit.removeChosen();
    mEdit.beginDrag(1);
    mEdit.endDrag();
    expectSame();
    EXPECT_TRUE(mEdit.canRedo());
}

}  // namespace
}  // namespace stereonav
