// What is made of the side that a volume is seen from: of two that are put together by hand, and of scenes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <glm/vector_relational.hpp>

#include "app/scene/volume/inside.h"
#include "app/scene/volume/light_loading.h"
#include "app/scene/volume/side.h"
#include "app/scene/volume/volume_loading.h"
#include "app/view/pointed_place.h"
#include "engine/base/error.h"
#include "tests/app/volume_input.h"

namespace stereonav {
namespace {

using VolumeSideOfScenes = test::VolumeTest;

// A block of voxels of 1 mm; a colon's has a line of 20 mm through it.
ColonScene block(bool colon) {
    VolumeFrame frame;
    frame.size = {8, 8, 32};
    frame.spacing = glm::dvec3(1e-3);
    ColonScene volume;
    volume.volume.field = GreyVolume(frame);
    volume.volume.cells.isovalue = 50;
    if (!colon) return volume;
    volume.lumen.lumen = MaskVolume(frame);
    for (int n = 0; n <= 20; ++n) {
        CentrelinePoint point;
        point.position = {4e-3, 4e-3, (4 + n) * 1e-3};
        point.radius = 3e-3;
        volume.centreline.points.push_back(point);
    }
    return volume;
}

std::string saidBy(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(VolumeSide, LightFromOutsideNeverGetsIntoAColon) {
    const ColonScene colon = block(true), surface = block(false);
    const auto inside = sideOf(colon), outside = sideOf(surface);
    BakeOptions sky, reaching, lamps;
    sky.sky = reaching.sky = lamps.sky = glm::vec3(1);
    reaching.reach_mm = 5;
    lamps.lights.resize(1);
    EXPECT_NE(saidBy([&] { inside->checkLight(sky, BakeKind::Irradiance); }), "");
    EXPECT_NE(saidBy([&] { inside->checkLight({}, BakeKind::Transfer); }), "");
    EXPECT_EQ(saidBy([&] { inside->checkLight(reaching, BakeKind::Irradiance); }), "");
    EXPECT_EQ(saidBy([&] { inside->checkLight(lamps, BakeKind::Irradiance); }), "");
    EXPECT_EQ(saidBy([&] { outside->checkLight(sky, BakeKind::Transfer); }), "");
    EXPECT_NE(saidBy([&] { inside->checkLazyLight(true, false); }), "");
    EXPECT_NE(saidBy([&] { inside->checkLazyLight(false, true); }), "");
    EXPECT_EQ(saidBy([&] { outside->checkLazyLight(true, true); }), "");
}

TEST(VolumeSide, WhatIsSaidOfOutsideIsRefusedInside) {
    const ColonScene colon = block(true), surface = block(false);
    EXPECT_THAT(saidBy([&] { sideOf(colon)->expectOutside("--ambient"); }),
                testing::StartsWith("--ambient: needs a volume seen from outside"));
    EXPECT_EQ(saidBy([&] { sideOf(surface)->expectOutside("--ambient"); }), "");
    LightSetup setup;
    EXPECT_THAT(saidBy([&] { sideOf(surface)->addLine(std::nullopt, "--light", setup); }),
                testing::StartsWith("--light: expected a colon for lights along the centreline"));
}

TEST(VolumeSide, AColonAloneHasALineAndARegion) {
    const ColonScene colon = block(true), surface = block(false);
    const auto inside = sideOf(colon), outside = sideOf(surface);
    ASSERT_TRUE(inside->interior());
    EXPECT_FALSE(outside->interior());
    EXPECT_EQ(inside->region(), &colon.lumen.lumen);
    EXPECT_EQ(outside->region(), nullptr);
    const PlaceOnLine place = inside->interior()->placeOnLine({5e-3, 4e-3, 9e-3});
    EXPECT_NEAR(place.along, 5e-3, 1e-9);
    EXPECT_NEAR(place.length, 20e-3, 1e-9);
    const LineOnMap& line = inside->interior()->lineOnMap();
    ASSERT_EQ(line.places.size(), 21u);
    EXPECT_NEAR(line.places[7].along, 7e-3, 1e-9);
    EXPECT_EQ(line.places[7].world, colon.centreline.points[7].position);
    EXPECT_NEAR(line.places.back().along, place.length, 1e-12);
    EXPECT_FALSE(inside->movableIsovalue());
    EXPECT_EQ(outside->movableIsovalue(), 50);
    std::vector<std::string> notes;
    EXPECT_NEAR(inside->usualReach(notes), 3e-3, 1e-9);
    EXPECT_EQ(notes.size(), 1u);
    EXPECT_EQ(outside->usualReach(notes), 0);
    EXPECT_EQ(notes.size(), 1u);
    LightSetup setup;
    outside->addUsualLight("--light", setup, notes);
    EXPECT_EQ(setup.sky, glm::vec3(1));
    EXPECT_TRUE(setup.lights.empty());
}

std::string textOf(const Facts& facts, const std::string& key) {
    for (const Fact& fact : facts)
        if (fact.key == key) return fact.text;
    return "";
}

// Facts of a place on the wall: its place in the patient, along the line, and once slices are read the value.
TEST_F(VolumeSideOfScenes, APlaceIsToldInThePatientsDirections) {
    SceneOptions options;
    options.scene = maskedTube();
    options.volume.cache = false;
    Progress progress;
    const auto colon = loadColonScene(options, SimdTarget::Auto, progress);
    const glm::dvec3 at = colon->startPose.position;
    const Facts facts = factsOfPlace(*colon, nullptr, at, at + glm::dvec3(0, 0, 0.02));
    EXPECT_EQ(textOf(facts, "distance_m"), "20.0 mm away");
    EXPECT_EQ(textOf(facts, "along_mm"),
              fmt::format("{:.0f} mm along", 1000 * colon->offered<LineThrough>()->placeOnLine(at).along));
    EXPECT_EQ(textOf(facts, "value"), "");
    const auto study = colon->offered<SliceSource>()->readSlices(progress);
    EXPECT_EQ(textOf(factsOfPlace(*colon, study.get(), at, at), "value"), "value 1") << "of the mask";
    EXPECT_EQ(textOf(factsOfPlace(*colon, study.get(), at + 10.0, at), "value"), "") << "beside the study";
    const Facts signs = factsOfPlace(*colon, nullptr, {-0.001, 0.002, -0.0035}, at);
    EXPECT_EQ(textOf(signs, "place_mm"), "R 1.0  P 2.0  I 3.5 mm");
}

TEST_F(VolumeSideOfScenes, IsWhatTheyOffer) {
    SceneOptions options;
    options.scene = maskedTube();
    options.volume.cache = false;
    Progress progress;
    const auto colon = loadColonScene(options, SimdTarget::Auto, progress);
    ASSERT_TRUE(colon->offered<const ColonInterior>());
    EXPECT_GT(colon->offered<const ColonInterior>()->centreline().length(), 0.02);
    EXPECT_GE(colon->offered<const ColonInterior>()->segments(), 1u);
    ASSERT_TRUE(colon->offered<LineThrough>());
    EXPECT_GT(colon->offered<LineThrough>()->placeOnLine(colon->startPose.position).length, 0.02);
    ASSERT_TRUE(colon->offered<LineOnMap>());
    EXPECT_GT(colon->offered<LineOnMap>()->places.size(), 10u);
    ASSERT_TRUE(colon->offered<SceneBox>());
    const glm::dvec3 start = colon->startPose.position;
    EXPECT_TRUE(glm::all(glm::lessThan(colon->offered<SceneBox>()->low, start)));
    EXPECT_TRUE(glm::all(glm::lessThan(start, colon->offered<SceneBox>()->high)));
    EXPECT_FALSE(colon->offered<MapFromAbove>());
    EXPECT_TRUE(colon->offered<SliceSource>()->lumen());
    options.scene = ball();
    options.volume.isosurface = true;
    const auto surface = loadColonScene(options, SimdTarget::Auto, progress);
    EXPECT_FALSE(surface->offered<const ColonInterior>());
    EXPECT_FALSE(surface->offered<LineThrough>());
    EXPECT_FALSE(surface->offered<LineOnMap>());
    EXPECT_TRUE(surface->offered<SceneBox>());
    EXPECT_FALSE(surface->offered<SliceSource>()->lumen());
    EXPECT_TRUE(surface->offered<RoomAround>());
}

}  // namespace
}  // namespace stereonav
