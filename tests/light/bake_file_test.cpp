// Bakes are given back as they were kept; whatever is wrong with a file is named, and none of it is used.
#include "engine/light/bake/bake_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "engine/base/hash.h"
#include "engine/light/bake/bake_job.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint64_t kKey = 0x123456789abcdefull;
constexpr std::size_t kHeaderBytes = 232, kBrickBytes = 88;  // sizes as in docs/formats.md

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

BakeSums someSums(BakeKind kind, int channels = 1) {
    VolumeFrame frame = test::slantedFrame({13, 9, 7});
    std::vector<TexelBrick> bricks;
    for (const std::uint32_t n : {0u, 2u, 3u}) {
        TexelBrick brick{n, {}};
        brick.wanted[n] = 0x0000010110ull + n;
        brick.wanted[5] = 0x11;
        bricks.push_back(brick);
    }
    BakeSums sums(frame, bricks, {kind, 2, channels});
    test::Random random(5);
    const auto any = [&] { return static_cast<float>(random.between(0, 4)); };
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        sums.samples[n] = static_cast<std::uint32_t>(16 * n);
        sums.estimates[n] = {0.25 * static_cast<double>(n), 3.5};
        for (TexelSum& t : sums.light(n)) t = {glm::vec3(any(), any(), any()), any(), any()};
        for (float& v : sums.transfer(n)) v = any();
        for (std::uint8_t& a : sums.alive(n)) a = any() > 2;
    }
    return sums;
}

template <typename Span>
std::string bytesOf(const Span& span) {
    return {reinterpret_cast<const char*>(span.data()), span.size_bytes()};
}

class BakeFileTest : public testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() / ("stereonav-bake-test-" + std::to_string(getpid()));
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
    }
    void TearDown() override { fs::remove_all(mFolder); }
    fs::path file() const { return mFolder / "a.bake"; }
    void write(const std::string& bytes) const { std::ofstream(file(), std::ios::binary) << bytes; }
    // Returns what is wrong with these bytes; "" for nothing.
    std::string problemOf(const std::string& bytes) const {
        write(bytes);
        std::string problem;
        const auto read = readBakeFile(file(), kKey, problem);
        EXPECT_EQ(read.has_value(), problem.empty());
        return problem;
    }
    fs::path mFolder;
};

TEST_F(BakeFileTest, GivesBackWhatWasKept) {
    for (const BakeKind kind : {BakeKind::Irradiance, BakeKind::Transfer, BakeKind::Openness})
        for (const int channels : {1, 3}) {
            const BakeSums sums = someSums(kind, channels);
            writeBakeFile(file(), {kKey, 77}, sums);
            EXPECT_FALSE(isForeignFile(file()));
            std::string problem = "?";
            const auto read = readBakeFile(file(), kKey, problem);
            ASSERT_TRUE(read) << problem;
            EXPECT_EQ(problem, "");
            EXPECT_EQ(read->identity.key, kKey);
            EXPECT_EQ(read->identity.content, 77u);
            EXPECT_EQ(read->sums.frame().origin, sums.frame().origin);
            EXPECT_EQ(read->sums.frame().axes, sums.frame().axes);
            EXPECT_EQ(read->sums.frame().spacing, sums.frame().spacing);
            EXPECT_EQ(read->sums.frame().size, sums.frame().size);
            EXPECT_EQ(read->sums.shape().kind, kind);
            EXPECT_EQ(read->sums.shape().order, 2);
            EXPECT_EQ(read->sums.shape().channels, channels);
            EXPECT_EQ(read->sums.samples, sums.samples);
            ASSERT_EQ(read->sums.bricks().size(), 3u);
            for (std::size_t n = 0; n < 3; ++n) {
                EXPECT_EQ(read->sums.bricks()[n].number, sums.bricks()[n].number);
                EXPECT_EQ(read->sums.bricks()[n].wanted, sums.bricks()[n].wanted);
                EXPECT_EQ(read->sums.estimates[n].variance, sums.estimates[n].variance);
                EXPECT_EQ(bytesOf(read->sums.light(n)), bytesOf(sums.light(n)));
                EXPECT_EQ(bytesOf(read->sums.transfer(n)), bytesOf(sums.transfer(n)));
                EXPECT_EQ(bytesOf(read->sums.alive(n)), bytesOf(sums.alive(n)));
            }
        }
}

TEST_F(BakeFileTest, NoFileIsNoProblem) {
    std::string problem = "?";
    EXPECT_FALSE(readBakeFile(file(), kKey, problem));
    EXPECT_EQ(problem, "");
    EXPECT_FALSE(isForeignFile(file()));
    EXPECT_FALSE(readBakeFile(mFolder, kKey, problem));
    EXPECT_NE(problem, "");
}

// Every byte is covered by a hash or checked itself.
TEST_F(BakeFileTest, AnyChangedByteIsNoticed) {
    for (const BakeKind kind : {BakeKind::Irradiance, BakeKind::Transfer}) {
        writeBakeFile(file(), {kKey, 77}, someSums(kind));
        const std::string whole = contentOf(file());
        ASSERT_EQ(problemOf(whole), "");
        // All of the header, and of what has one hash for all some.
        for (std::size_t n = 0; n < whole.size(); n += n < kHeaderBytes ? 1 : 23) {
            std::string changed = whole;
            changed[n] = static_cast<char>(changed[n] ^ (1 << n % 8));
            ASSERT_NE(problemOf(changed), "") << n;
        }
    }
}

TEST_F(BakeFileTest, CutOffAnywhereOrGrownIsNoticed) {
    writeBakeFile(file(), {kKey, 77}, someSums(BakeKind::Transfer));
    const std::string whole = contentOf(file());
    for (std::size_t n = 0; n < whole.size(); n += 11) {
        const std::string problem = problemOf(whole.substr(0, n));
        ASSERT_THAT(problem, HasSubstr("is cut off")) << n;
        ASSERT_THAT(problem, HasSubstr(std::to_string(n) + " bytes"));
    }
    EXPECT_THAT(problemOf(whole + "x"), HasSubstr("grown"));
}

TEST_F(BakeFileTest, SaysWhatIsWrong) {
    writeBakeFile(file(), {kKey, 77}, someSums(BakeKind::Irradiance));
    const std::string whole = contentOf(file());
    EXPECT_THAT(problemOf(std::string(300, 'x')), HasSubstr("no bake"));
    const auto changed = [&](std::size_t at) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 2);
        return problemOf(bytes);
    };
    EXPECT_THAT(changed(8), HasSubstr("format version " + std::to_string(whole[8] ^ 2)));
    EXPECT_THAT(changed(58), HasSubstr("header"));
    EXPECT_THAT(changed(kHeaderBytes + 20), HasSubstr("bricks"));
    EXPECT_THAT(changed(whole.size() - 3), HasSubstr("sums"));
    write(whole);
    std::string problem;
    EXPECT_FALSE(readBakeFile(file(), kKey + 1, problem));
    EXPECT_THAT(problem, HasSubstr("something else"));
    EXPECT_TRUE(readBakeFile(file(), std::nullopt, problem));
}

// Headers whose hash is right and whose numbers are nonsense: nothing is allocated, nothing crashes.
TEST_F(BakeFileTest, NonsenseThatHashesRightIsRefused) {
    writeBakeFile(file(), {kKey, 77}, someSums(BakeKind::Transfer));
    const std::string whole = contentOf(file());
    struct Field {
        const char* name;
        std::size_t at, bytes;
    };
    const Field fields[] = {{"kind", 12, 4},     {"size x", 40, 4},  {"size z", 48, 4},  {"order", 52, 4},
                            {"channels", 56, 4}, {"bricks", 184, 8}, {"texels", 192, 8}, {"bytes", 32, 8}};
    for (const Field& field : fields)
        for (const std::uint64_t value : {0ull, 7ull, 1ull << 20, 1ull << 31, ~0ull, 1ull << 62}) {
            std::string bytes = whole;
            std::memcpy(bytes.data() + field.at, &value, field.bytes);
            if (bytes == whole) continue;
            const std::uint64_t hash = Hash().add(bytes.data(), kHeaderBytes - 8).value();
            std::memcpy(bytes.data() + kHeaderBytes - 8, &hash, 8);
            // A larger grid around the same bricks is another bake, but a sound one.
            const std::string problem = problemOf(bytes);
            const bool grid = std::string(field.name).starts_with("size") && value > 0 && value <= 1u << 20;
            EXPECT_TRUE(grid || !problem.empty()) << field.name << " " << value;
        }
}

TEST_F(BakeFileTest, BricksThatHashRightAndCanNotBeAreRefused) {
    writeBakeFile(file(), {kKey, 77}, someSums(BakeKind::Irradiance));
    const std::string whole = contentOf(file());
    const auto problemWith = [&](const std::function<void(char*)>& change) {
        std::string bytes = whole;
        change(bytes.data() + kHeaderBytes);
        const std::uint64_t bricks = Hash().add(bytes.data() + kHeaderBytes, 3 * kBrickBytes).value();
        std::memcpy(bytes.data() + 200, &bricks, 8);
        const std::uint64_t hash = Hash().add(bytes.data(), kHeaderBytes - 8).value();
        std::memcpy(bytes.data() + kHeaderBytes - 8, &hash, 8);
        return problemOf(bytes);
    };
    EXPECT_EQ(problemWith([](char*) {}), "");
    EXPECT_THAT(problemWith([](char* b) { b[0] = 9; }), HasSubstr("can not be"));                // order
    EXPECT_THAT(problemWith([](char* b) { b[2 * kBrickBytes] = 9; }), HasSubstr("can not be"));  // range
    EXPECT_THAT(problemWith([](char* b) { b[24] ^= 1; }), HasSubstr("do not fit"));              // count
    EXPECT_THAT(problemWith([](char* b) { std::memset(b + 24, 0, 64); }), HasSubstr("can not be"));
}

TEST_F(BakeFileTest, ForeignFilesAreTold) {
    write("");
    EXPECT_FALSE(isForeignFile(file()));
    write("hello");
    EXPECT_TRUE(isForeignFile(file()));
    write("a photograph that someone wants to keep");
    EXPECT_TRUE(isForeignFile(file()));
    EXPECT_TRUE(isForeignFile(mFolder));
}

TEST_F(BakeFileTest, WhereItCanNotBeWrittenIsSaid) {
    write("x");
    EXPECT_THROW(writeBakeFile(file() / "inside.bake", {kKey, 77}, someSums(BakeKind::Openness)), Error);
}

}  // namespace
}  // namespace stereonav
