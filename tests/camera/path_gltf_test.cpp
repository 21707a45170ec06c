// Camera paths in glTF: round trips, files written by hand against closed forms, and bad files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/recorded_path.h"
#include "engine/gltf/gltf_file.h"
#include "engine/math/constants.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A glTF text over one buffer file. Placeholders @name@ of the text are replaced by `set`.
struct HandMade {
    const TemporaryFolder& folder;
    std::string buffer;
    std::string text;

    template <typename T>
    HandMade& append(std::initializer_list<T> values) {
        for (const T& v : values) buffer.append(reinterpret_cast<const char*>(&v), sizeof v);
        return *this;
    }
    HandMade& set(const std::string& name, const std::string& value) {
        const std::string key = "@" + name + "@";
        for (auto at = text.find(key); at != text.npos; at = text.find(key))
            text.replace(at, key.size(), value);
        return *this;
    }
    std::filesystem::path write() {
        set("bytes", std::to_string(buffer.size()));
        std::ofstream(folder / "hand.bin", std::ios::binary) << buffer;
        std::ofstream(folder / "hand.gltf") << text;
        return folder / "hand.gltf";
    }
};

// Times, translations and rotations of two keyframes: the first 3 accessors; 8 + 24 + 32 bytes.
const char* const kTwoKeys = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"camera":0,"translation":[9,9,9]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"buffers":[{"uri":"hand.bin","byteLength":@bytes@}],
"bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":24},
{"buffer":0,"byteOffset":32,"byteLength":32}],
"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC4"}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},
{"sampler":1,"target":{"node":0,"path":"rotation"}}],
"samplers":[{"input":0,"output":1,"interpolation":"@mode@"},{"input":0,"output":2}]}]})";

HandMade twoKeys(const TemporaryFolder& folder, float time0, float time1) {
    const float h = static_cast<float>(std::sqrt(0.5));
    HandMade made{folder, "", kTwoKeys};
    made.append({time0, time1}).append({1.f, 2.f, 3.f, 5.f, 2.f, 3.f});
    return made.append({0.f, 0.f, 0.f, 1.f, 0.f, h, 0.f, h});
}

std::string messageOf(const std::filesystem::path& file) {
    try {
        readPath(file);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(StartsWith(file.string() + ":"), Not(HasSubstr("\n"))));
        return error.what();
    }
    return "no error";
}

std::string changedMessage(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
    HandMade made = twoKeys(folder, 0, 1).set("mode", "LINEAR");
    const auto at = made.text.find(from);
    EXPECT_NE(at, made.text.npos) << from;
    made.text.replace(at, from.size(), to);
    return messageOf(made.write());
}

RecordedPath someFlight(int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> metres(-20000, 20000), angle(-3, 3), step(0.01, 2);
    std::vector<PathSample> samples;
    for (double time = 0.5; static_cast<int>(samples.size()) < count; time += step(random))
        samples.push_back({time, poseFromAngles({metres(random), metres(random), metres(random)},
                                                angle(random), angle(random) / 2, angle(random))});
    return RecordedPath(std::move(samples), "made");
}

// 1e-6 of the size of the numbers: times and positions are 32-bit floats in glTF.
TEST(GltfPath, RoundTripKeepsSixDigits) {
    const TemporaryFolder folder;
    const RecordedPath path = someFlight(200);
    for (const char* name : {"a.gltf", "a.glb"}) {
        writePath(folder / name, path);
        const RecordedPath again = readPath(folder / name);
        ASSERT_EQ(again.samples().size(), 200u) << name;
        for (std::size_t k = 0; k < 200; ++k) {
            const PathSample &a = path.samples()[k], &b = again.samples()[k];
            ASSERT_NEAR(a.time, b.time, 1e-6 * a.time);
            ASSERT_LT(glm::distance(a.pose.position, b.pose.position), 1e-6 * glm::length(a.pose.position));
            ASSERT_LT(1 - std::abs(glm::dot(a.pose.orientation, b.pose.orientation)), 1e-12);
            ASSERT_LT(glm::distance(a.pose.forward(), b.pose.forward()), 1e-6);
        }
    }
}

// What other programs need: a scene that holds the node, a perspective camera, LINEAR channels.
TEST(GltfPath, WrittenFileIsAnAnimatedCamera) {
    const TemporaryFolder folder;
    writePath(folder / "a.glb", someFlight(3));
    const GltfFile file = readGltf(folder / "a.glb");
    EXPECT_EQ(readTextFile(folder / "a.glb").substr(0, 4), "glTF");
    ASSERT_EQ(file.model.scenes.size(), 1u);
    EXPECT_EQ(file.model.scenes[0].nodes, std::vector<int>{0});
    ASSERT_EQ(file.model.nodes[0].camera, 0);
    EXPECT_EQ(file.model.cameras[0].type, "perspective");
    EXPECT_GT(file.model.cameras[0].perspective.yfov, 0);
    ASSERT_EQ(file.model.animations.size(), 1u);
    ASSERT_EQ(file.model.animations[0].channels.size(), 2u);
    for (const auto& sampler : file.model.animations[0].samplers) EXPECT_EQ(sampler.interpolation, "LINEAR");
    EXPECT_EQ(file.model.accessors[0].minValues.size(), 1u);
    EXPECT_EQ(file.model.accessors[0].maxValues.size(), 1u);
}

// An unturned glTF camera looks along glTF's -z, which is north; glTF's y is up.
TEST(GltfPath, YUpBecomesZUp) {
    const TemporaryFolder folder;
    const RecordedPath path = readPath(twoKeys(folder, 1, 3).set("mode", "LINEAR").write());
    ASSERT_EQ(path.samples().size(), 2u);
    EXPECT_EQ(path.samples()[0].time, 1);
    const Pose& first = path.samples()[0].pose;
    EXPECT_LT(glm::distance(first.position, glm::dvec3(1, -3, 2)), 1e-9);
    EXPECT_LT(glm::distance(first.forward(), glm::dvec3(0, 1, 0)), 1e-6);
    EXPECT_LT(glm::distance(first.up(), glm::dvec3(0, 0, 1)), 1e-6);
    // A quarter turn about glTF's y turns the view to the left: west.
    EXPECT_LT(glm::distance(path.samples()[1].pose.forward(), glm::dvec3(-1, 0, 0)), 1e-6);
    EXPECT_NEAR(anglesOf(path.at(2)).heading, 1.75 * kPi, 1e-6);
    EXPECT_LT(glm::distance(path.at(2).position, glm::dvec3(3, -3, 2)), 1e-9);
}

TEST(GltfPath, StepHoldsUntilTheNextKeyframe) {
    const TemporaryFolder folder;
    const RecordedPath path = readPath(twoKeys(folder, 0, 2).set("mode", "STEP").write());
    for (const double time : {0.0, 0.5, 1.0, 1.9}) EXPECT_NEAR(path.at(time).position.x, 1, 1e-9) << time;
    EXPECT_NEAR(path.at(2).position.x, 5, 1e-9);
    EXPECT_NEAR(anglesOf(path.at(1)).heading, 1.75 * kPi, 1e-3) << "the rotation channel stays LINEAR";
}

// Cubic Hermite with p(0) = 0, p'(0) = 0, p(2) = 4, p'(2) = 4 is the parabola t^2.
TEST(GltfPath, CubicSplineFollowsTheParabola) {
    const TemporaryFolder folder;
    HandMade made{folder, "", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"camera":0}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"buffers":[{"uri":"hand.bin","byteLength":@bytes@}],
"bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":72}],
"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":0,"output":1,"interpolation":"CUBICSPLINE"}]}]})"};
    made.append({0.f, 2.f});
    made.append({7.f, 7.f, 7.f, 0.f, 0.f, 0.f, 0.f, 0.f, 0.f});  // in-tangent (unused), value, out-tangent
    made.append({4.f, 0.f, 0.f, 4.f, 0.f, 0.f, 7.f, 7.f, 7.f});
    const RecordedPath path = readPath(made.write());
    EXPECT_GT(path.samples().size(), 10u);
    EXPECT_LT(path.samples().size(), 600u);
    for (int k = 0; k <= 100; ++k) {
        const double t = 0.02 * k;
        ASSERT_NEAR(path.at(t).position.x, t * t, 1e-4) << t;
    }
}

// A turning arm: the camera hangs 5 m off a node that turns once by 180 degrees in two keyframe steps.
TEST(GltfPath, MovingParentsAreHonoured) {
    const TemporaryFolder folder;
    HandMade made{folder, "", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1]}],
"nodes":[{"camera":0,"translation":[0,0,5]},{"children":[2],"translation":[100,0,0]},{"children":[0],"scale":[2,2,2]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"buffers":[{"uri":"hand.bin","byteLength":@bytes@}],
"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
{"bufferView":1,"componentType":5122,"normalized":true,"count":3,"type":"VEC4"}],
"animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}}],
"samplers":[{"input":0,"output":1}]}]})"};
    const std::int16_t h = static_cast<std::int16_t>(std::lround(32767 * std::sqrt(0.5)));
    made.append({0.f, 1.f, 2.f});
    made.append<std::int16_t>({0, 0, 0, 32767, 0, h, 0, h, 0, 32767, 0, 0});
    const RecordedPath path = readPath(made.write());
    for (int k = 0; k <= 40; ++k) {
        const double t = 0.05 * k, a = t * kPi / 2;
        const Pose pose = path.at(t);
        // Arm of 5 m, scaled by 2: glTF (100 + 10 sin a, 0, 10 cos a), looking back along it.
        ASSERT_LT(glm::distance(pose.position, glm::dvec3(100 + 10 * std::sin(a), -10 * std::cos(a), 0)),
                  1e-3)
            << t;
        ASSERT_LT(glm::distance(pose.forward(), glm::dvec3(-std::sin(a), std::cos(a), 0)), 1e-3) << t;
    }
}

// Time and position interleaved in one buffer view of 16 bytes a step.
TEST(GltfPath, StridesAreHonoured) {
    const TemporaryFolder folder;
    HandMade made{folder, "", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"camera":0}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"buffers":[{"uri":"hand.bin","byteLength":@bytes@}],
"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":16}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
{"bufferView":0,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3"}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":0,"output":1}]}]})"};
    made.append({0.f, 1.f, 0.f, 0.f, 1.f, 2.f, 0.f, 0.f, 2.f, 30.f, 0.f, 0.f});
    const RecordedPath path = readPath(made.write());
    ASSERT_EQ(path.samples().size(), 3u);
    EXPECT_EQ(path.samples()[2].pose.position.x, 30);
}

// The second place is given by its number, over the buffer's own and over nothing.
TEST(GltfPath, SparseKeyframesCount) {
    const TemporaryFolder folder;
    for (const bool base : {true, false}) {
        HandMade made = twoKeys(folder, 0, 1).set("mode", "LINEAR");
        made.append<std::uint16_t>({1, 0}).append({9.f, 8.f, 7.f});
        const auto replace = [&](const std::string& from, const std::string& to) {
            const auto at = made.text.find(from);
            ASSERT_NE(at, made.text.npos) << from;
            made.text.replace(at, from.size(), to);
        };
        replace(R"("byteOffset":32,"byteLength":32}])",
                R"("byteOffset":32,"byteLength":32},{"buffer":0,"byteOffset":64,"byteLength":2},)"
                R"({"buffer":0,"byteOffset":68,"byteLength":12}])");
        replace(R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"})",
                std::string(base ? R"({"bufferView":1,)" : "{") +
                    R"("componentType":5126,"count":2,"type":"VEC3","sparse":{"count":1,)"
                    R"("indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":4}}})");
        const RecordedPath path = readPath(made.write());
        ASSERT_EQ(path.samples().size(), 2u);
        const glm::dvec3 first = base ? glm::dvec3(1, -3, 2) : glm::dvec3(0.0);
        EXPECT_LT(glm::distance(path.samples()[0].pose.position, first), 1e-9) << base;
        EXPECT_LT(glm::distance(path.samples()[1].pose.position, glm::dvec3(9, -7, 8)), 1e-9) << base;
    }
}

TEST(GltfPath, BadKeyframesAreNamed) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(messageOf(twoKeys(folder, 1, 1).set("mode", "LINEAR").write()),
                HasSubstr("animation 0, channel 0, keyframe 1: expected a time after 1 s, got 1 s"));
    EXPECT_THAT(messageOf(twoKeys(folder, 2, 1).set("mode", "LINEAR").write()),
                HasSubstr("expected a time after 2 s"));
    EXPECT_THAT(messageOf(twoKeys(folder, 0, nan).set("mode", "LINEAR").write()),
                HasSubstr("not a finite number"));
    HandMade zero = twoKeys(folder, 0, 1).set("mode", "LINEAR");
    zero.buffer.replace(48, 16, 16, '\0');  // the second rotation
    EXPECT_THAT(messageOf(zero.write()),
                HasSubstr("animation 0, channel 1, keyframe 1: expected a quaternion that is not zero"));
    EXPECT_THAT(messageOf(twoKeys(folder, 0, 1).set("mode", "CUBIC").write()),
                HasSubstr("expected LINEAR, STEP or CUBICSPLINE, got \"CUBIC\""));
}

TEST(GltfPath, BadStructureIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(changedMessage(folder, "\"camera\":0,", ""),
                HasSubstr("expected a node with a camera, found none"));
    EXPECT_THAT(changedMessage(folder, "\"animations\"", "\"others\""), HasSubstr("expected an animation"));
    EXPECT_THAT(changedMessage(folder, "\"input\":0,\"output\":1", "\"input\":77,\"output\":1"),
                HasSubstr("animation 0, channel 0: refers to accessor 77, the file has 3"));
    EXPECT_THAT(changedMessage(folder, "\"input\":0,\"output\":1", "\"input\":0,\"output\":2"),
                HasSubstr("expected 3 numbers an element"));
    EXPECT_THAT(changedMessage(folder, "\"sampler\":0", "\"sampler\":9"),
                HasSubstr("refers to sampler 9 of 2"));
    EXPECT_THAT(changedMessage(folder, "\"count\":2,\"type\":\"VEC3\"", "\"count\":3,\"type\":\"VEC3\""),
                AllOf(HasSubstr("accessor 1"), HasSubstr("expected 3 elements")));
    EXPECT_THAT(
        changedMessage(folder, "\"count\":2,\"type\":\"VEC3\"", "\"count\":4000000000,\"type\":\"VEC3\""),
        HasSubstr("accessor 1"));
    EXPECT_THAT(
        changedMessage(folder, "\"byteOffset\":8,\"byteLength\":24", "\"byteOffset\":60,\"byteLength\":24"),
        HasSubstr("expected 24 bytes from 60"));
    EXPECT_THAT(changedMessage(folder, "\"count\":2,\"type\":\"SCALAR\"", "\"count\":1,\"type\":\"SCALAR\""),
                HasSubstr("expected 1 values for 1 times, got 2"));
    EXPECT_THAT(changedMessage(folder, "\"nodes\":[0]", "\"nodes\":[5]"), HasSubstr("refers to node 5"));
    EXPECT_THAT(changedMessage(folder, "\"camera\":0,", "\"camera\":0,\"children\":[0],"),
                HasSubstr("its own ancestor"));
    EXPECT_THAT(
        changedMessage(folder, "\"node\":0,\"path\":\"translation\"", "\"node\":0,\"path\":\"weights\""),
        "no error");  // the rotation channel is still a path
    EXPECT_THAT(changedMessage(folder, "\"asset\":{\"version\":\"2.0\"}",
                               "\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco\"]"),
                HasSubstr("needs KHR_draco"));
    EXPECT_THAT(changedMessage(folder, "\"asset\"", "\"asset"),
                HasSubstr("is not glTF 2.0 that can be read"));
}

// Cut anywhere, a file gives its one line; nothing crashes and nothing is taken for a path.
TEST(GltfPath, TruncatedFilesGiveOneLine) {
    const TemporaryFolder folder;
    for (const char* name : {"a.glb", "a.gltf"}) {
        writePath(folder / name, someFlight(5));
        const std::string whole = readTextFile(folder / name);
        for (std::size_t size = 0; size < whole.size() - 1; size += 1 + whole.size() / 97) {
            std::ofstream(folder / name, std::ios::binary) << whole.substr(0, size);
            ASSERT_NE(messageOf(folder / name), "no error") << name << " cut to " << size;
        }
    }
}

TEST(GltfPath, DamagedBinaryFrameIsNamed) {
    const TemporaryFolder folder;
    writePath(folder / "a.glb", someFlight(5));
    std::string bytes = readTextFile(folder / "a.glb");
    bytes[12] = bytes[13] = bytes[14] = '\x7f';  // length of the JSON chunk
    std::ofstream(folder / "a.glb", std::ios::binary) << bytes;
    EXPECT_THAT(messageOf(folder / "a.glb"), HasSubstr("chunk at byte 12"));
    EXPECT_THAT(messageOf(folder / "none.glb"), HasSubstr("can not be opened"));
    std::ofstream(folder / "empty.glb");
    EXPECT_THAT(messageOf(folder / "empty.glb"), HasSubstr("the file is empty"));
}

TEST(GltfPath, WhatFloatsCanNotKeepIsRefusedAndNothingWritten) {
    const TemporaryFolder folder;
    const auto refused = [&](double time0, double time1) -> std::string {
        try {
            writePath(folder / "a.glb", RecordedPath({{time0, {}}, {time1, {}}}, "made"));
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_THAT(refused(1e6, 1e6 + 0.01),
                AllOf(HasSubstr("pose 2"), HasSubstr("too close"), HasSubstr(".path")));
    EXPECT_THAT(refused(-1, 1), AllOf(HasSubstr("pose 1"), HasSubstr("0 s or later")));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

}  // namespace
}  // namespace stereonav
