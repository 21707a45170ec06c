// Where the numbers of a mesh come from: sparse accessors with and without data under them, and integers of
// KHR_mesh_quantization. Files are written by hand after glTF 2.0, 3.6.2, byte by byte.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/mesh/mesh_file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using test::errorOf;
using testing::AllOf;
using testing::HasSubstr;

// A glTF of one primitive: its bytes, a buffer view for each piece of them, and accessors as text.
class WrittenMesh {
public:
    // Returns the number of the buffer view.
    template <typename T>
    int view(const std::vector<T>& values, int stride = 0) {
        mBytes.resize((mBytes.size() + 3) / 4 * 4);
        mViews += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}{}}})",
                              mViews.empty() ? "" : ",", mBytes.size(), values.size() * sizeof(T),
                              stride > 0 ? fmt::format(R"(,"byteStride":{})", stride) : "");
        mBytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return mCount++;
    }
    // Gives the primitive's attribute, or "indices", an accessor. more: members beside type and count.
    void give(const std::string& name, const std::string& type, int component, long long count,
              const std::string& more) {
        mAccessors +=
            fmt::format(R"({}{{"componentType":{},"count":{},"type":"{}"{}{}}})",
                        mAccessors.empty() ? "" : ",", component, count, type, more.empty() ? "" : ",", more);
        if (name == "indices")
            mIndices = fmt::format(R"("indices":{},)", mGiven);
        else
            mAttributes += fmt::format(R"({}"{}":{})", mAttributes.empty() ? "" : ",", name, mGiven);
        ++mGiven;
    }
    TriangleMesh read(const std::string& node = "", const std::string& extensions = "") const {
        const TemporaryFolder folder;
        std::ofstream(folder / "hand.bin", std::ios::binary) << mBytes;
        std::ofstream(folder / "hand.gltf") << fmt::format(
            R"({{"asset":{{"version":"2.0"}},{}"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],
"meshes":[{{"primitives":[{{{}"attributes":{{{}}}}}]}}],"accessors":[{}],
"buffers":[{{"uri":"hand.bin","byteLength":{}}}],"bufferViews":[{}]}})",
            extensions, node, mIndices, mAttributes, mAccessors, mBytes.size(), mViews);
        return readMesh(folder / "hand.gltf");
    }

private:
    std::string mBytes, mViews, mAccessors, mAttributes, mIndices;
    int mCount = 0, mGiven = 0;
};

std::string sparseText(int count, int indices, int indexType, int values, int indicesAt = 0,
                       int valuesAt = 0) {
    return fmt::format(R"("sparse":{{"count":{},"indices":{{"bufferView":{},"byteOffset":{},)"
                       R"("componentType":{}}},"values":{{"bufferView":{},"byteOffset":{}}}}})",
                       count, indices, indicesAt, indexType, values, valuesAt);
}

void expectPositions(const TriangleMesh& mesh, const std::vector<glm::dvec3>& gltf) {
    ASSERT_EQ(mesh.vertices.size(), gltf.size());
    for (std::size_t k = 0; k < gltf.size(); ++k) {
        const glm::dvec3 world(gltf[k].x, -gltf[k].z, gltf[k].y);  // glTF is y up
        ASSERT_LT(glm::distance(mesh.vertices[k].position, world), 1e-9) << k;
    }
}

const std::vector<float> kStrip{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};  // two rows of three

TEST(SparseAccessor, ItsElementsReplaceThoseOfTheBufferView) {
    for (const int type : {5121, 5123, 5125}) {
        WrittenMesh written;
        const int base = written.view(kStrip);
        const int indices = type == 5121   ? written.view<std::uint8_t>({9, 3, 5})
                            : type == 5123 ? written.view<std::uint16_t>({9, 3, 5})
                                           : written.view<std::uint32_t>({9, 3, 5});
        const int values = written.view<float>({7, 0, 4, 0, 2, 3, -5});
        // Both begin behind a number that does not belong to them.
        const int size = type == 5121 ? 1 : type == 5123 ? 2 : 4;
        written.give(
            "POSITION", "VEC3", 5126, 6,
            fmt::format(R"("bufferView":{},{})", base, sparseText(2, indices, type, values, size, 4)));
        SCOPED_TRACE(type);
        const TriangleMesh mesh = written.read();
        expectPositions(mesh, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 4, 0}, {1, 1, 0}, {2, 3, -5}});
        EXPECT_EQ(mesh.triangles.size(), 2u);
    }
}

TEST(SparseAccessor, WithoutABufferViewTheOthersAreZero) {
    WrittenMesh written;
    const int indices = written.view<std::uint16_t>({1, 5});
    const int values = written.view<float>({4, 5, 6, 1, 2, 3});
    written.give("POSITION", "VEC3", 5126, 6, sparseText(2, indices, 5123, values));
    const glm::dvec3 zero(0.0);
    expectPositions(written.read(), {zero, {4, 5, 6}, zero, zero, zero, {1, 2, 3}});
}

TEST(SparseAccessor, GivesNormalsTexturePlacesColoursAndIndicesToo) {
    WrittenMesh written;
    written.give("POSITION", "VEC3", 5126, 6, fmt::format(R"("bufferView":{})", written.view(kStrip)));
    const int one = written.view<std::uint8_t>({4});
    // Normals of normalised bytes over normals of bytes: 127 is 1.
    const int up = written.view<std::int8_t>(
        {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, 4);
    const int aside = written.view<std::int8_t>({-127, 0, 0});
    written.give("NORMAL", "VEC3", 5120, 6,
                 fmt::format(R"("normalized":true,"bufferView":{},{})", up, sparseText(1, one, 5121, aside)));
    const int place = written.view<std::uint16_t>({65535, 0});
    written.give("TEXCOORD_0", "VEC2", 5123, 6, R"("normalized":true,)" + sparseText(1, one, 5121, place));
    const int colour = written.view<float>({0.25, 0.5, 0.75});
    written.give("COLOR_0", "VEC3", 5126, 6, sparseText(1, one, 5121, colour));
    const int corners = written.view<std::uint16_t>({0, 1, 3, 1, 0, 3});
    const int third = written.view<std::uint16_t>({4});
    written.give("indices", "SCALAR", 5123, 6,
                 fmt::format(R"("bufferView":{},{})", corners, sparseText(1, one, 5121, third)));
    const TriangleMesh mesh = written.read();
    ASSERT_EQ(mesh.vertices.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) {
        const auto& v = mesh.vertices[k];
        // glTF's z is the world's -y.
        EXPECT_EQ(v.normal, k == 4 ? glm::vec3(-1, 0, 0) : glm::vec3(0, -1, 0)) << k;
        EXPECT_EQ(v.uv, k == 4 ? glm::vec2(1, 0) : glm::vec2(0)) << k;
        EXPECT_EQ(v.color, k == 4 ? glm::vec3(0.25, 0.5, 0.75) : glm::vec3(0)) << k;
    }
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_THAT(mesh.triangles[1].vertex, testing::ElementsAre(1, 4, 3));
}

// A sparse accessor whose numbers are changed one at a time.
struct SparseNumbers {
    int count = 2, indexType = 5121, indexView = 1, valueView = 2, indicesAt = 0, valuesAt = 0;
    long long elements = 6;
    bool base = true;
};

std::string problemOf(const SparseNumbers& numbers) {
    WrittenMesh written;
    const int base = written.view(kStrip);
    written.view<std::uint8_t>({1, 6, 0, 0, 0, 0, 0, 0});
    written.view<float>({1, 1, 1, 2, 2, std::numeric_limits<float>::infinity()});
    written.give("POSITION", "VEC3", 5126, numbers.elements,
                 (numbers.base ? fmt::format(R"("bufferView":{},)", base) : "") +
                     sparseText(numbers.count, numbers.indexView, numbers.indexType, numbers.valueView,
                                numbers.indicesAt, numbers.valuesAt));
    const std::string problem = errorOf([&] { written.read(); });
    EXPECT_EQ(problem.find('\n'), std::string::npos);
    return problem;
}

TEST(SparseAccessor, WhatDoesNotFitIsRefusedByItsAccessor) {
    const std::string place = "hand.gltf:accessor 0, sparse: ";
    EXPECT_THAT(problemOf({}), HasSubstr(place + "expected elements 0 to 5, got 6"));
    EXPECT_THAT(problemOf({.count = 0}), HasSubstr(place + "expected 1 to 6 elements, got 0"));
    EXPECT_THAT(problemOf({.count = 7}), HasSubstr(place + "expected 1 to 6 elements, got 7"));
    EXPECT_THAT(problemOf({.count = -1}), HasSubstr(place + "expected 1 to 6 elements, got -1"));
    EXPECT_THAT(problemOf({.indexType = 5126}),
                HasSubstr(place + "expected indices of type 5121, 5123 or 5125, got 5126"));
    EXPECT_THAT(problemOf({.indexType = 5122}), HasSubstr("got 5122"));
    EXPECT_THAT(problemOf({.indicesAt = -1}), HasSubstr(place + "expected offsets of 0 bytes or more"));
    EXPECT_THAT(problemOf({.valuesAt = -4}), HasSubstr(place + "expected offsets of 0 bytes or more"));
    EXPECT_THAT(problemOf({.indexView = 9}), HasSubstr(place + "refers to buffer view 9, the file has 3"));
    EXPECT_THAT(problemOf({.valueView = 9}), HasSubstr(place + "refers to buffer view 9, the file has 3"));
    EXPECT_THAT(problemOf({.indicesAt = 7}), HasSubstr(place + "expected 2 elements of 1 bytes"));
    EXPECT_THAT(problemOf({.valuesAt = 4}), HasSubstr(place + "expected 2 elements of 12 bytes"));
    EXPECT_THAT(problemOf({.count = 3}), HasSubstr(place + "expected 3 elements of 12 bytes"));
    EXPECT_THAT(problemOf({.count = 1, .valuesAt = 12}), HasSubstr("is not a finite number"));
    EXPECT_THAT(problemOf({.elements = 7}), HasSubstr("accessor 0: expected 7 elements"));
}

// Nothing is taken for what a file counts and has no bytes for.
TEST(SparseAccessor, CountsWithoutDataAreBounded) {
    for (const long long elements : {(1ll << 22) + 1, 1ll << 40, std::numeric_limits<long long>::max()})
        EXPECT_THAT(problemOf({.elements = elements, .base = false}),
                    AllOf(HasSubstr("accessor 0: expected at most 4194304 elements where there is no data"),
                          HasSubstr(fmt::format("got {}", elements))));
}

// Integers as gltfpack writes them: positions that a node scales back, eight bytes apart.
TEST(QuantizedMesh, IsReadAsItsIntegersSay) {
    WrittenMesh written;
    const int positions = written.view<std::uint16_t>({0, 0, 0, 7, 1000, 0, 0, 7, 0, 500, 65535, 7}, 8);
    written.give("POSITION", "VEC3", 5123, 3, fmt::format(R"("bufferView":{})", positions));
    const int normals = written.view<std::int16_t>({0, 0, 32767, 0, 0, 0, 32767, 0, 0, 0, -32767, 0}, 8);
    written.give("NORMAL", "VEC3", 5122, 3, fmt::format(R"("normalized":true,"bufferView":{})", normals));
    const int places = written.view<std::int8_t>({0, 127, 0, 0, -128, 64, 0, 0, 127, 0, 0, 0}, 4);
    written.give("TEXCOORD_0", "VEC2", 5120, 3, fmt::format(R"("normalized":true,"bufferView":{})", places));
    const TriangleMesh mesh = written.read(R"(,"scale":[0.001,0.01,0.1],"translation":[1,2,3])",
                                           R"("extensionsUsed":["KHR_mesh_quantization"],)"
                                           R"("extensionsRequired":["KHR_mesh_quantization"],)");
    expectPositions(mesh, {{1, 2, 3}, {2, 2, 3}, {1, 7, 6556.5}});
    EXPECT_LT(glm::distance(mesh.vertices[0].normal, glm::vec3(0, -1, 0)), 1e-6);
    EXPECT_LT(glm::distance(mesh.vertices[2].normal, glm::vec3(0, 1, 0)), 1e-6);
    // -128 is -1 as -127 is.
    EXPECT_LT(glm::distance(mesh.vertices[0].uv, glm::vec2(0, 1)), 1e-6);
    EXPECT_LT(glm::distance(mesh.vertices[1].uv, glm::vec2(-1, 64 / 127.0)), 1e-6);
}

TEST(QuantizedMesh, IntegersThatAreNotNormalisedStayWhole) {
    WrittenMesh written;
    const int positions = written.view<std::int8_t>({-128, 0, 0, 0, 127, 0, 0, 0, 0, 100, -3, 0}, 4);
    written.give("POSITION", "VEC3", 5120, 3, fmt::format(R"("bufferView":{})", positions));
    const int places = written.view<std::uint8_t>({0, 200, 0, 0, 3, 4, 0, 0, 255, 1, 0, 0}, 4);
    written.give("TEXCOORD_0", "VEC2", 5121, 3, fmt::format(R"("bufferView":{})", places));
    const TriangleMesh mesh = written.read("", R"("extensionsRequired":["KHR_mesh_quantization"],)");
    expectPositions(mesh, {{-128, 0, 0}, {127, 0, 0}, {0, 100, -3}});
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0, 200));
    EXPECT_EQ(mesh.vertices[2].uv, glm::vec2(255, 1));
}

}  // namespace
}  // namespace stereonav
