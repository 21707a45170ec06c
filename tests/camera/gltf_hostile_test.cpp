// glTF files that somebody made to do more than be shown: too deep, too wide, or naming files elsewhere.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

#include "engine/camera/recorded_path.h"
#include "engine/gltf/gltf_file.h"
#include "engine/gltf/gltf_size.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int n = 0; n < count; ++n) all += text;
    return all;
}

// "asset", and more members of the description.
std::string gltfWith(const std::string& members) {
    return R"({"asset":{"version":"2.0"},)" + members + "}";
}

std::string asBinary(std::string json, const std::string& buffer) {
    const auto word = [](std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&number), sizeof number);
    };
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string chunks = word(json.size()) + "JSON" + json;
    if (!buffer.empty()) chunks += word(buffer.size()) + std::string("BIN\0", 4) + buffer;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

class HostileGltf : public testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((mFolder / name).parent_path());
        std::ofstream(mFolder / name, std::ios::binary) << bytes;
        return mFolder / name;
    }
    std::string errorFor(const std::string& name, const std::string& bytes) const {
        return test::errorOf([&] { readGltf(write(name, bytes)); });
    }
    // Returns the error where only `bytes` of memory can be had.
    std::string errorWithin(const char* bytes, const std::string& name, const std::string& content) const {
        setenv("STEREONAV_MEMORY", bytes, 1);
        const std::string error = errorFor(name, content);
        unsetenv("STEREONAV_MEMORY");
        return error;
    }

    TemporaryFolder mFolder;
};

TEST_F(HostileGltf, NestedValuesAreRefusedBeforeTheyAreParsed) {
    for (const auto& [open, close] : {std::pair("[", "]"), {"{\"a\":", "}"}})
        for (const int depth : {200, 20000, 200000})
            for (const char* where : {"\"extras\":", "\"nodes\":[{\"extensions\":{\"a\":", "\"a\":"}) {
                const std::string rest = std::strchr(where, '[') ? "}}]" : "";
                const std::string json =
                    gltfWith(where + repeated(open, depth) + "1" + repeated(close, depth) + rest);
                EXPECT_THAT(errorFor("a.gltf", json),
                            AllOf(HasSubstr("a.gltf:byte "), HasSubstr("at most 100")))
                    << depth << where;
                EXPECT_THAT(errorFor("a.glb", asBinary(json, "")), HasSubstr("at most 100"));
            }
    EXPECT_EQ(errorFor("a.gltf", gltfWith("\"extras\":" + repeated("[", 90) + "1" + repeated("]", 90))),
              "no error");
}

TEST_F(HostileGltf, ManyObjectsAreRefusedAndFewerTakeWhatIsAsked) {
    const std::string wide = repeated("{},", 300000) + "{}";
    for (const char* list : {"nodes", "meshes", "n\\u006fdes", "textures"}) {
        const std::string json = gltfWith(fmt::format("\"{}\":[{}]", list, wide));
        EXPECT_THAT(errorWithin("150e6", "a.gltf", json),
                    AllOf(HasSubstr("a.gltf: needs "), HasSubstr("split")))
            << list;
    }
    EXPECT_EQ(errorFor("a.gltf", gltfWith("\"nodes\":[" + wide + "]")), "no error");
    const std::string extras = gltfWith("\"extras\":[" + repeated("0,", 1000000) + "0]");
    EXPECT_THAT(errorWithin("150e6", "a.gltf", extras), HasSubstr("a.gltf: needs "));
    EXPECT_THAT(errorFor("a.gltf", gltfWith("\"nodes\":[" + repeated("{},", kMostGltfObjects) + "{}]")),
                HasSubstr("describes more than 2000000 objects"));
    EXPECT_THAT(errorFor("a.gltf", gltfWith("\"materials\":[" + wide + "]")),
                HasSubstr("has more than 100000 materials"));
}

// Each buffer without a file is a copy of the one that the .glb has.
TEST_F(HostileGltf, CopiesOfTheBinaryPartAreAskedFor) {
    const std::string part(1 << 20, 'x');
    const auto buffers = [&](const std::string& each, int count) {
        return asBinary(gltfWith("\"buffers\":[" + repeated(each + ",", count - 1) + each + "]"), part);
    };
    for (const char* each : {R"({"byteLength":1048576})", R"({"uri":"","byteLength":1048576})",
                             R"({"uri":"a","uri":5,"byteLength":1048576})"})
        EXPECT_THAT(errorWithin("900e6", "a.glb", buffers(each, 1000)), HasSubstr("a.glb: needs 1.")) << each;
    EXPECT_EQ(errorWithin("900e6", "a.glb", buffers(R"({"byteLength":1048576})", 3)), "no error");
}

TEST_F(HostileGltf, FilesElsewhereAreNamedAndNotRead) {
    write("secret.bin", "abcd");
    write("in/own.bin", "abcd");
    write("in/below/a b.bin", "abcd");
    const auto buffer = [](const std::string& uri) {
        return gltfWith(R"("buffers":[{"byteLength":4,"uri":")" + uri + "\"}]");
    };
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("%2e%2e%2fsecret.bin"), std::string("%2E./secret.bin"),
          std::string("below/../../secret.bin"), std::string("..\\u002fsecret.bin"),
          (mFolder / "secret.bin").string(), std::string("%2fetc%2fpasswd")}) {
        EXPECT_THAT(errorFor("in/a.gltf", buffer(uri)),
                    AllOf(HasSubstr("in/a.gltf: names the file \""),
                          HasSubstr("not in its own folder or below"), Not(HasSubstr("\n"))))
            << uri;
        EXPECT_THAT(errorFor("in/a.gltf", gltfWith(R"("images":[{"uri":")" + uri + "\"}]")),
                    HasSubstr("not in its own folder or below"))
            << uri;
    }
    for (const std::string& uri :
         {std::string("own.bin"), std::string("./own.bin"), std::string("below/a%20b.bin"),
          std::string("../in/own.bin"), (mFolder / "in/own.bin").string()}) {
        const GltfFile file = readGltf(write("in/a.gltf", buffer(uri)));
        ASSERT_EQ(file.model.buffers.size(), 1u);
        EXPECT_EQ(file.model.buffers[0].data.size(), 4u) << uri;
    }
    fs::create_symlink("../secret.bin", mFolder / "in/link.bin");
    EXPECT_EQ(errorFor("in/a.gltf", buffer("link.bin")), "no error") << "who made the link meant it";
    EXPECT_THAT(errorFor("in/a.gltf", buffer("none.bin")), HasSubstr("File not found : none.bin"));
}

// tinygltf would look there as well.
TEST_F(HostileGltf, TheFolderThatOneIsInIsNoPlaceForItsFiles) {
    write("here/a.bin", "abcd");
    const fs::path file = write("in/a.gltf", gltfWith(R"("buffers":[{"byteLength":4,"uri":"a.bin"}])"));
    const fs::path before = fs::current_path();
    fs::current_path(mFolder / "here");
    const std::string error = test::errorOf([&] { readGltf(file); });
    fs::current_path(before);
    EXPECT_THAT(error, HasSubstr("File not found : a.bin"));
}

TEST_F(HostileGltf, WhatIsNoFileHoldsUpNothing) {
    ASSERT_EQ(mkfifo((mFolder / "pipe").c_str(), 0600), 0);
    fs::create_directory(mFolder / "folder");
    for (const auto& [name, kind] : {std::pair("pipe", "a pipe"), {"folder", "a folder"}}) {
        const std::string uri = fmt::format("\"uri\":\"{}\"", name), expected = fmt::format("found {}", kind);
        EXPECT_THAT(errorFor("a.gltf", gltfWith(R"("buffers":[{"byteLength":4,)" + uri + "}]")),
                    AllOf(HasSubstr(name), HasSubstr(expected)));
        EXPECT_THAT(errorFor("a.gltf", gltfWith("\"images\":[{" + uri + "}]")),
                    AllOf(HasSubstr(name), HasSubstr(expected)));
    }
}

// Chains of nodes are walked along, not kept: their numbers would be the square of their length.
TEST_F(HostileGltf, NodesAreMetOnceFromTheRootsDown) {
    constexpr int kRows = 200, kDeep = 900;
    std::string roots, nodes;
    for (int r = 0; r < kRows; ++r) {
        roots += fmt::format("{}{}", r ? "," : "", r * kDeep);
        for (int n = 0; n < kDeep; ++n)
            nodes +=
                fmt::format("{}{}", r || n ? "," : "",
                            n + 1 < kDeep ? fmt::format("{{\"children\":[{}]}}", r * kDeep + n + 1) : "{}");
    }
    const GltfFile file = readGltf(
        write("a.gltf", gltfWith("\"scenes\":[{\"nodes\":[" + roots + "]}],\"nodes\":[" + nodes + "]")));
    const std::vector<MetNode> met = nodesOfScene(file);
    ASSERT_EQ(met.size(), static_cast<std::size_t>(kRows) * kDeep);
    for (int n = 0; n < kRows * kDeep; ++n) {
        ASSERT_EQ(met[n].node, n);
        ASSERT_EQ(met[n].above, n % kDeep == 0 ? -1 : n - 1);
    }
    const auto errorOfNodes = [&](const std::string& list) {
        const fs::path place =
            write("b.gltf", gltfWith("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" + list + "]"));
        return test::errorOf([&] { nodesOfScene(readGltf(place)); });
    };
    EXPECT_THAT(errorOfNodes(R"({"children":[1]},{"children":[0]})"), HasSubstr("its own ancestor"));
    EXPECT_THAT(errorOfNodes(R"({"children":[1]},{"children":[1]},{},{})"), HasSubstr("its own ancestor"));
    EXPECT_THAT(errorOfNodes(R"({"children":[1,-1]},{})"), HasSubstr("refers to node -1"));
    EXPECT_THAT(errorOfNodes(R"({"children":[1,2]},{})"), HasSubstr("refers to node 2"));
}

// Times, and a path of translations through two of them, in one buffer of the text.
std::string flown(const std::string& nodes, const std::string& channels) {
    return gltfWith(R"("scenes":[{"nodes":[0]}],"cameras":[{"type":"perspective","perspective":{"yfov":1,)"
                    R"("znear":0.1}}],"nodes":[)" +
                    nodes + R"(],"animations":[{"channels":[)" + channels +
                    R"(],"samplers":[{"input":0,"output":1}]}],)"
                    R"("buffers":[{"byteLength":32,"uri":"data:application/octet-stream;base64,)"
                    R"(AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA="}],"bufferViews":[{"buffer":0,)"
                    R"("byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":24}],"accessors":[)"
                    R"({"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},)"
                    R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"}])");
}

TEST_F(HostileGltf, OfManyCamerasTheFirstThatMovesIsFlown) {
    constexpr int kMovers = 20000;  // each with a camera above it
    std::string nodes = R"({"children":[)", channels;
    for (int n = 0; n < kMovers; ++n) nodes += fmt::format("{}{}", n ? "," : "", 2 * n + 1);
    nodes += "]}";
    for (int n = 0; n < kMovers; ++n)
        nodes += fmt::format(R"(,{{"children":[{}]}},{{"camera":0,"translation":[0,{},0]}})", 2 * n + 2, n);
    for (int n = kMovers - 1; n >= 7; --n)
        channels += fmt::format(R"({}{{"sampler":0,"target":{{"node":{},"path":"translation"}}}})",
                                n + 1 < kMovers ? "," : "", 2 * n + 1);
    const RecordedPath path = readPath(write("a.gltf", flown(nodes, channels)));
    ASSERT_EQ(path.samples().size(), 2u);
    EXPECT_NEAR(path.samples()[1].pose.position.x, 1, 1e-6);
    EXPECT_NEAR(path.samples()[1].pose.position.z, 7, 1e-6);
}

TEST_F(HostileGltf, NodesThatStandStillAreAskedForOnce) {
    std::string nodes;
    for (int n = 0; n < 500; ++n)
        nodes += fmt::format(R"({{"translation":[0,0,1],"children":[{}]}},)", n + 1);
    nodes += R"({"camera":0})";
    const RecordedPath path = readPath(
        write("a.gltf", flown(nodes, R"({"sampler":0,"target":{"node":250,"path":"translation"}})")));
    ASSERT_EQ(path.samples().size(), 2u);
    EXPECT_NEAR(path.samples()[1].pose.position.x, 1, 1e-6);
    EXPECT_NEAR(path.samples()[1].pose.position.y, -499, 1e-6);
}

TEST_F(HostileGltf, APartIsMovedByOneChannel) {
    const std::string channel = R"({"sampler":0,"target":{"node":0,"path":"translation"}})";
    const auto errorOfPath = [&](const std::string& channels) {
        const fs::path place = write("a.gltf", flown(R"({"camera":0})", channels));
        return test::errorOf([&] { readPath(place); });
    };
    EXPECT_EQ(errorOfPath(channel), "no error");
    EXPECT_THAT(errorOfPath(channel + "," + channel),
                HasSubstr("expected one channel for the translation of node 0, found two"));
}

}  // namespace
}  // namespace stereonav
