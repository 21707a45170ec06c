// The line that is measured in the window: its places, what of it is kept, and figures from the work beside
// it.
#include "app/view/measured_line.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/view/kept_file.h"
#include "engine/base/error.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/gate.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// Reports how many places it was asked for; for four it fails.
class CountingScene final : public Scene, public LineMeasurer {
public:
    CountingScene() { offer<LineMeasurer>(*this); }
    FrameMaker& frames() const override { throw Error("", "", "no frames", ""); }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed,
                            Progress& progress) const override {
        progress.report(0.5, "measuring");
        while (places.size() == 5 && closed) progress.report(0.25, "measuring, which does not end by itself");
        if (places.size() == 4) throw Error("", "the line", "has four places", "take three");
        MeasuredSurface measured;
        measured.facts = {factForJson("places", static_cast<std::int64_t>(places.size())),
                          factForJson("closed", closed)};
        return measured;
    }
};

void settle(MeasuredLine& line) {
    EXPECT_TRUE(test::waitFor([&] { return !line.poll() && !line.busy(); }));
}

std::int64_t placesSaid(const MeasuredLine& line) {
    return std::get<std::int64_t>(line.measured()->facts.at(0).value);
}

TEST(MeasuredLine, ALongLineIsTakenEvenlyThinned) {
    MeasuredLine line([] {});
    line.open(std::make_shared<CountingScene>(), "");
    std::vector<glm::dvec3> places;
    for (int n = 0; n < 2500; ++n) places.emplace_back(n, 0, 0);
    EXPECT_TRUE(line.take(places, false));
    ASSERT_EQ(line.places().size(), MeasuredLine::kMost);
    EXPECT_EQ(line.places().front().x, 0);
    EXPECT_EQ(line.places().back().x, 2499);
    for (std::size_t n = 1; n < MeasuredLine::kMost; ++n)
        EXPECT_NEAR(line.places()[n].x - line.places()[n - 1].x, 2499.0 / 999, 1);
    EXPECT_FALSE(line.take({{5, 5, 5}}, false)) << "one place is no line";
    EXPECT_FALSE(line.take({{5, 5, 5}, {5, 5, 5}}, false)) << "twice the same";
    EXPECT_EQ(line.places().size(), MeasuredLine::kMost) << "and nothing is changed";
    EXPECT_TRUE(line.take({{0, 0, 0}, {1, 0, 0}}, true));
    EXPECT_FALSE(line.closed()) << "two places enclose nothing";
    settle(line);
    EXPECT_EQ(placesSaid(line), 2);
}

TEST(MeasuredLine, IsMeasuredBesideTheWindowEachTimeItChanges) {
    std::atomic<int> woken = 0;
    MeasuredLine line([&] { ++woken; });
    line.open(std::make_shared<CountingScene>(), "");
    EXPECT_FALSE(line.busy());
    EXPECT_TRUE(line.add({1, 2, 3}));
    EXPECT_FALSE(line.busy()) << "one place is no line";
    EXPECT_FALSE(line.add({1, 2, 3})) << "twice the same";
    EXPECT_TRUE(line.add({4, 2, 3}));
    EXPECT_TRUE(line.busy());
    settle(line);
    ASSERT_TRUE(line.measured());
    EXPECT_EQ(placesSaid(line), 2);
    EXPECT_GE(woken, 1);
    line.setClosed(true);
    settle(line);
    EXPECT_FALSE(std::get<bool>(line.measured()->facts.at(1).value)) << "two places enclose nothing";
    line.add({4, 5, 3});
    settle(line);
    EXPECT_EQ(placesSaid(line), 3);
    EXPECT_TRUE(std::get<bool>(line.measured()->facts.at(1).value));
    // A failure has a reason, and the next change goes on.
    line.add({9, 9, 9});
    settle(line);
    EXPECT_FALSE(line.measured());
    EXPECT_NE(line.problem().find("has four places"), std::string::npos) << line.problem();
    line.removeLast();
    settle(line);
    EXPECT_EQ(placesSaid(line), 3);
    EXPECT_EQ(line.problem(), "");
    // With changes during a measurement the last one counts.
    for (int n = 0; n < 20; ++n) line.add({n, 0, 0}), line.poll();
    settle(line);
    EXPECT_EQ(placesSaid(line), 23);
    line.clear();
    settle(line);
    EXPECT_FALSE(line.measured());
    EXPECT_FALSE(line.closed());
    line.removeLast();
    EXPECT_TRUE(line.places().empty());
}

TEST(MeasuredLine, LongMeasuringTellsItsShareAndEndsWithAnyChange) {
    std::optional<MeasuredLine> line(std::in_place, [] {});
    line->open(std::make_shared<CountingScene>(), "");
    ASSERT_TRUE(line->take({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {0, 5, 0}}, true));
    ASSERT_TRUE(test::waitFor([&] { return !line->poll() && line->fraction() == 0.25; }));
    EXPECT_TRUE(line->busy());
    line->setClosed(false);
    settle(*line);
    ASSERT_TRUE(line->measured());
    EXPECT_EQ(placesSaid(*line), 5);
    EXPECT_EQ(line->problem(), "");
    line->setClosed(true);
    line->poll();
    line.reset();  // ends it, too
}

TEST(MeasuredLine, IsKeptAsItIsMade) {
    const TemporaryFolder folder;
    const auto file = folder / "lines" / "one.json";
    const auto scene = std::make_shared<CountingScene>();
    {
        MeasuredLine line([] {});
        line.open(scene, file);
        line.add({1.25, -2, 1e-7});
        line.add({1e8, 0, 3});
        line.setClosed(true);
    }
    MeasuredLine again([] {});
    again.open(scene, file);
    ASSERT_EQ(again.places().size(), 2U);
    EXPECT_EQ(again.places()[0], glm::dvec3(1.25, -2, 1e-7));
    EXPECT_EQ(again.places()[1], glm::dvec3(1e8, 0, 3));
    EXPECT_TRUE(again.closed());
    settle(again);
    EXPECT_EQ(placesSaid(again), 2);
    again.clear();
    MeasuredLine none([] {});
    none.open(scene, file);
    EXPECT_TRUE(none.places().empty());
    for (const char* damaged : {"{", "{\"stereonav_line\":2,\"closed\":false,\"places_m\":[]}",
                                "{\"stereonav_line\":1,\"closed\":false,\"places_m\":[[1,2]]}",
                                "{\"stereonav_line\":1,\"closed\":false,\"places_m\":[[1,2,1e300]]}",
                                "{\"stereonav_line\":1,\"closed\":1,\"places_m\":[]}"}) {
        std::ofstream(file) << damaged;
        MeasuredLine line([] {});
        line.open(scene, file);
        EXPECT_TRUE(line.places().empty()) << damaged;
        EXPECT_NE(line.problem(), "") << damaged;
        EXPECT_FALSE(std::filesystem::exists(file)) << "set aside";
    }
    // The line goes on where nothing can be written.
    MeasuredLine line([] {});
    std::ofstream(folder / "plain").put('x');
    line.open(scene, folder / "plain" / "one.json");
    line.add({1, 2, 3});
    EXPECT_NE(line.problem(), "");
    EXPECT_EQ(line.places().size(), 1U);
}

TEST(MeasuredLine, HasAsManyPlacesAsItMay) {
    MeasuredLine line([] {});
    line.open(nullptr, "");
    for (std::size_t n = 0; n < MeasuredLine::kMost; ++n) EXPECT_TRUE(line.add({double(n), 0, 0}));
    EXPECT_FALSE(line.add({-1, 0, 0}));
    line.poll();
    EXPECT_FALSE(line.measured());
}

TEST(MeasuredLine, WithoutAMeasurerIsMeasuredFromPlaceToPlace) {
    FakeFrames frames;
    FakeParts parts;
    parts.frames = &frames;
    MeasuredLine line([] {});
    line.open(opened(parts)->scene, "");
    line.add({0, 0, 0});
    line.add({0, 0.003, 0.004});
    line.add({0, 0, 0.004});
    settle(line);
    ASSERT_TRUE(line.measured());
    const Facts& facts = line.measured()->facts;
    EXPECT_NEAR(std::get<double>(facts.at(0).value), 0.008, 1e-15);
    EXPECT_NEAR(std::get<double>(facts.at(1).value), 0.004, 1e-15) << "from end to end";
    EXPECT_EQ(line.measured()->places.size(), 3U);
    EXPECT_TRUE(line.measured()->profile.empty());
    line.setClosed(true);
    settle(line);
    EXPECT_NEAR(std::get<double>(line.measured()->facts.at(0).value), 0.012, 1e-15);
    EXPECT_EQ(line.measured()->places.size(), 4U);
}

// Waits at the gate, is not told of its end, and reports the places and eye height that it was asked for.
class LateScene final : public Scene, public LineMeasurer {
public:
    explicit LateScene(double number) : mNumber(number) { offer<LineMeasurer>(*this); }
    FrameMaker& frames() const override { throw Error("", "", "no frames", ""); }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed, Progress&) const override {
        if (places.back().x == 99) gate.pass();
        if (places.back().y == 99) {
            gate.pass();
            throw Error("", "the line", "is of before", "forget it");
        }
        MeasuredSurface measured;
        measured.facts = {factForJson("scene", mNumber), factForJson("last", places.back().x),
                          factForJson("closed", closed)};
        return measured;
    }
    Facts sight(const glm::dvec3&, const glm::dvec3&, double height) const override {
        return {factForJson("eye", height)};
    }
    mutable test::Gate gate;

private:
    double mNumber;
};

double said(const MeasuredLine& line, const std::string& key) {
    if (!line.measured()) return -1;
    for (const Fact& fact : line.measured()->facts)
        if (fact.key == key) return std::get<double>(fact.value);
    return -2;
}

// After any change during a measurement its result is not taken: neither figures nor a failure.
TEST(MeasuredLine, WhatWasMeasuredBeforeAChangeIsNotTaken) {
    const auto late = std::make_shared<LateScene>(1), other = std::make_shared<LateScene>(2);
    struct Change {
        const char* name;
        std::function<void(MeasuredLine&)> make;
        double scene, last, eye;  // values that it reports in the end; -1: none
    };
    const std::vector<Change> changes = {
        {"a place more",
         [](MeasuredLine& line) {
             line.add({5, 0, 0});
         },
         1, 5, 2},
        {"a place less", [](MeasuredLine& line) { line.removeLast(); }, 1, 1, 2},
        {"none", [](MeasuredLine& line) { line.clear(); }, -1, -1, -1},
        {"another line",
         [](MeasuredLine& line) {
             line.take({{0, 0, 0}, {7, 0, 0}}, false);
         },
         1, 7, 2},
        {"another scene", [&](MeasuredLine& line) { line.replaceScene(other), line.removeLast(); }, 2, 1, 2},
        {"another file", [&](MeasuredLine& line) { line.open(other, ""); }, -1, -1, -1},
        {"another eye", [](MeasuredLine& line) { line.removeLast(), line.setEyeHeight(9); }, 1, 1, 9},
    };
    for (const bool fails : {false, true})
        for (const Change& change : changes) {
            SCOPED_TRACE(std::string(change.name) + (fails ? ", failing" : ""));
            late->gate.close();
            MeasuredLine line([] {});
            line.open(late, "");
            line.add({0, 0, 0}), line.add({1, 0, 0});
            fails ? line.add({8, 99, 0}) : line.add({99, 0, 0});
            const int before = late->gate.came();
            line.poll();
            late->gate.await(before + 1);
            change.make(line);
            EXPECT_FALSE(line.measured()) << "nothing was measured yet";
            late->gate.open();
            settle(line);
            EXPECT_EQ(said(line, "scene"), change.scene);
            EXPECT_EQ(said(line, "last"), change.last);
            EXPECT_EQ(said(line, "eye"), change.eye);
            EXPECT_EQ(line.problem(), "");
        }
}

// A, B, A: the same places are measured again, with the same result.
TEST(MeasuredLine, ThereAndBackSaysTheSame) {
    const auto scene = std::make_shared<LateScene>(1), other = std::make_shared<LateScene>(2);
    MeasuredLine line([] {});
    line.open(scene, "");
    line.add({0, 0, 0}), line.add({1, 0, 0});
    const std::vector<std::pair<std::function<void()>, std::function<void()>>> detours = {
        {[&] {
             line.add({4, 0, 0});
         },
         [&] { line.removeLast(); }},
        {[&] { line.setEyeHeight(8); }, [&] { line.setEyeHeight(2); }},
        {[&] { line.replaceScene(other); }, [&] { line.replaceScene(scene); }},
        {[&] {
             line.add({4, 0, 0}), line.setClosed(true);
         },
         [&] { line.setClosed(false), line.removeLast(); }},
    };
    settle(line);
    const auto all = [&] {
        return std::vector<double>{said(line, "scene"), said(line, "last"), said(line, "eye")};
    };
    const std::vector<double> before = all();
    ASSERT_EQ(before, (std::vector<double>{1, 1, 2}));
    for (std::size_t n = 0; n < detours.size(); ++n)
        for (const bool waits : {true, false}) {
            SCOPED_TRACE(n);
            detours[n].first();
            line.poll();
            if (waits) {
                settle(line);
                EXPECT_NE(all(), before);
            }
            detours[n].second();
            settle(line);
            EXPECT_EQ(all(), before);
            EXPECT_FALSE(std::get<bool>(line.measured()->facts.at(2).value));
        }
}

TEST(MeasuredLine, LiesBesideThePlacesOfItsScene) {
    EXPECT_EQ(keptBeside("/home/a/.local/share/stereonav/places/12.json", "lines"),
              std::filesystem::path("/home/a/.local/share/stereonav/lines/12.json"));
    EXPECT_EQ(keptBeside("", "lines"), std::filesystem::path());
}

}  // namespace
}  // namespace stereonav
