// The lumen in the cache: written once, read back instead of being found again, and told from files that are
// another's, outdated or damaged. Nothing is ever written beside the study; a lumen that lies there is read.
#include "colon/scene/saved_lumen.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "colon/scene/colon_scene.h"
#include "engine/base/file.h"
#include "tests/support/made_ct.h"
#include "tests/support/volume_files.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// A tube with tagged fluid, and a bubble of gas that touches it through a wall one voxel thin.
const GreyVolume& tubeScan() {
    static const GreyVolume scan = test::scanned(
        test::filled({100, 100, 90}, 0.0012,
                     [](glm::dvec3 p) {
                         const bool gas = glm::length(p - glm::dvec3(0.0735, 0.050, 0.05)) < 0.0012;
                         return gas ? -1000 : test::TubeBody::hu(p);
                     }),
        0.0008, 15);
    return scan;
}

class SavedLumenTest : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "stereonav-lumen-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
        if (const char* before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
        fs::remove_all(mFolder);
    }
    fs::path study(const std::string& name = "tube.nrrd") const {
        const GreyVolume& scan = tubeScan();
        fs::create_directories(mFolder / "studies");
        const glm::ivec3 size = scan.frame.size;
        return test::writeNrrd(
            mFolder / "studies" / name,
            fmt::format("type: short\ndimension: 3\nsizes: {} {} {}\nspace: left-posterior-superior\n"
                        "space directions: (1.2,0,0) (0,1.2,0) (0,0,1.2)\nspace origin: (-30,20,7)\n"
                        "encoding: raw\nendian: little\n",
                        size.x, size.y, size.z),
            std::string(reinterpret_cast<const char*>(scan.values.data()),
                        scan.frame.count() * sizeof(std::int16_t)));
    }
    // Opens without the cache of what was found, as on another day or machine.
    ColonScene open(const fs::path& file, double wall = -450) const {
        std::error_code code;
        for (const auto& entry : fs::directory_iterator(cacheFolder(), code))
            if (entry.path().filename().string().starts_with("colon-")) fs::remove(entry.path());
        ColonOptions options;
        options.study = file;
        options.segmentation.wall = wall;
        Progress progress;
        return loadColon(options, progress);
    }
    fs::path beside() const { return mFolder / "studies/tube_lumen.nrrd"; }
    // The only one in the cache.
    static fs::path kept() {
        fs::path file;
        for (const auto& entry : fs::directory_iterator(cacheFolder()))
            if (entry.path().filename().string().starts_with("lumen-") &&
                entry.path().extension() == ".nrrd") {
                EXPECT_EQ(file, "") << "there is another one";
                file = entry.path();
            }
        return file;
    }
    long besideTheStudy() const {
        return std::distance(fs::directory_iterator(mFolder / "studies"), fs::directory_iterator());
    }
    fs::path mFolder;
    std::string mBefore;
};

void expectSameLumen(const ColonScene& a, const ColonScene& b) {
    ASSERT_EQ(a.lumen.lumen.frame.size, b.lumen.lumen.frame.size);
    const std::size_t count = a.lumen.lumen.frame.count();
    EXPECT_EQ(std::memcmp(a.lumen.lumen.values.data(), b.lumen.lumen.values.data(), count), 0);
    EXPECT_EQ(std::memcmp(a.volume.field.values.data(), b.volume.field.values.data(), 2 * count), 0);
    ASSERT_EQ(a.lumen.segments.size(), b.lumen.segments.size());
    for (std::size_t n = 0; n < a.lumen.segments.size(); ++n) {
        EXPECT_EQ(a.lumen.segments[n].voxels, b.lumen.segments[n].voxels);
        EXPECT_EQ(a.lumen.segments[n].first, b.lumen.segments[n].first);
        EXPECT_EQ(a.lumen.segments[n].last, b.lumen.segments[n].last);
    }
    EXPECT_EQ(a.centreline.points.size(), b.centreline.points.size());
}

TEST_F(SavedLumenTest, IsReadBackAndGivesTheSameSceneBitForBit) {
    const fs::path file = study();
    const ColonScene first = open(file);
    EXPECT_THAT(first.notes, Contains("lumen kept as " + kept().string()));
    EXPECT_THAT(first.notes, Contains(HasSubstr("1 pool(s) of tagged fluid")));
    EXPECT_EQ(besideTheStudy(), 1) << "something was written beside the study";
    const std::string bytes = test::fileBytes(kept());
    EXPECT_THAT(bytes.substr(0, 1000), HasSubstr("\nencoding: gzip\n"));
    EXPECT_THAT(bytes.substr(0, 1000), HasSubstr("\nstereonav lumen key:="));
    fs::last_write_time(kept(), fs::last_write_time(kept()) - std::chrono::hours(9));
    const auto before = fs::last_write_time(kept());
    const ColonScene again = open(file);
    EXPECT_THAT(again.notes, Contains("lumen read back from " + kept().string()));
    EXPECT_THAT(again.notes, Not(Contains(HasSubstr("kept as"))));
    EXPECT_EQ(test::fileBytes(kept()), bytes);
    EXPECT_GT(fs::last_write_time(kept()), before) << "its use is not noted";
    expectSameLumen(again, first);
}

TEST_F(SavedLumenTest, OtherSettingsAreOtherLumens) {
    const fs::path file = study();
    open(file);
    EXPECT_THAT(open(file, -500).notes, Contains(HasSubstr("lumen kept as ")));
    for (const double wall : {-450, -500})
        EXPECT_THAT(open(file, wall).notes, Contains(HasSubstr("read back"))) << wall;
    SegmentationSetting a, b;
    b.seeds = {{0, 0, 0.1}};
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(1, b));
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(2, a));
    b = {};
    b.tagged = 250;
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(1, b));
}

// Two patients' "ct.nrrd", and one study that is scanned again under the same name.
TEST_F(SavedLumenTest, StudiesOfOneNameDoNotMeet) {
    const fs::path file = study();
    const fs::path other = mFolder / "other" / file.filename();
    fs::create_directories(other.parent_path());
    std::string bytes = test::fileBytes(file);
    bytes[bytes.size() - 1] ^= 1;
    bytes[bytes.size() - 2] ^= 1;
    test::writeBytes(other, bytes);
    open(file);
    EXPECT_THAT(open(other).notes, Contains(HasSubstr("lumen kept as ")));
    EXPECT_THAT(open(file).notes, Contains(HasSubstr("read back")));
    EXPECT_THAT(open(other).notes, Contains(HasSubstr("read back")));
    bytes[bytes.size() - 1] ^= 2;
    test::writeBytes(other, bytes);
    EXPECT_THAT(open(other).notes, Contains(HasSubstr("lumen kept as ")));
}

TEST_F(SavedLumenTest, AnyDamageIsNamedAndMended) {
    const fs::path file = study();
    const ColonScene good = open(file);
    const std::string bytes = test::fileBytes(kept());
    std::string flipped = bytes, cut = bytes.substr(0, bytes.size() - 40), other = bytes;
    flipped[bytes.size() - 200] ^= 0x10;
    const std::size_t at = other.find("lumen hash:=") + 12;
    other[at] = other[at] == '0' ? '1' : '0';
    std::string moved = bytes;
    moved.replace(moved.find("space origin: ("), 15, "space origin: (9");
    std::string small = bytes;
    small.replace(small.find("sizes: "), 8, "sizes: 1");
    for (const std::string& damaged : {flipped, cut, other, moved, small}) {
        test::writeBytes(kept(), damaged);
        const ColonScene scene = open(file);
        EXPECT_THAT(scene.notes, Contains(HasSubstr("the lumen is found again")));
        EXPECT_THAT(scene.notes, Contains("lumen kept as " + kept().string()));
        expectSameLumen(scene, good);
        EXPECT_EQ(test::fileBytes(kept()), bytes);
    }
    for (const std::string nothing : {"", "a diary"}) {
        test::writeBytes(kept(), nothing);
        expectSameLumen(open(file), good);
        EXPECT_EQ(test::fileBytes(kept()), bytes);
    }
}

// An earlier version, or a user who carries it along with the study, may have left it there.
TEST_F(SavedLumenTest, OneBesideTheStudyIsReadAndLeftAsItIs) {
    const fs::path file = study();
    const ColonScene first = open(file);
    const std::string bytes = test::fileBytes(kept());
    fs::rename(kept(), beside());
    const ColonScene again = open(file);
    EXPECT_THAT(again.notes, Contains("lumen read back from " + beside().string()));
    expectSameLumen(again, first);
    EXPECT_THAT(open(file, -500).notes,
                Contains(beside().string() + " is of another study or other settings"));
    fs::remove(kept());
    for (const std::string& foreign :
         {std::string(), std::string("a diary"), std::string("NRRD0005\ntype: uint8\ndimension: 3\n\n0"),
          bytes.substr(0, bytes.size() - 40)}) {
        test::writeBytes(beside(), foreign);
        const ColonScene scene = open(file);
        expectSameLumen(scene, first);
        EXPECT_THAT(scene.notes, Contains(HasSubstr("lumen kept as ")));
        EXPECT_EQ(test::fileBytes(beside()), foreign);
        fs::remove(kept());
    }
}

TEST_F(SavedLumenTest, WorkGoesOnWhereItCanNotBeKept) {
    const fs::path file = study();
    const ColonScene good = open(file);
    fs::remove_all(mFolder / "cache");
    test::writeBytes(mFolder / "cache", "a file where the cache's folder should be");
    for (int n = 0; n < 2; ++n) {
        const ColonScene scene = open(file);
        expectSameLumen(scene, good);
        EXPECT_EQ(std::ranges::count_if(scene.notes,
                                        [](const std::string& note) {
                                            return note.find("could not be kept") != std::string::npos;
                                        }),
                  1);
    }
    EXPECT_EQ(besideTheStudy(), 1);
}

TEST_F(SavedLumenTest, NothingIsKeptWithoutTheCache) {
    ColonOptions options;
    options.study = study();
    options.cache = false;
    Progress progress;
    const ColonScene scene = loadColon(options, progress);
    EXPECT_TRUE(scene.isColon());
    EXPECT_EQ(besideTheStudy(), 1);
    EXPECT_FALSE(fs::exists(mFolder / "cache"));
}

TEST(SavedLumen, MayLieBesideTheStudy) {
    EXPECT_EQ(lumenBeside("/a/b.nrrd"), "/a/b_lumen.nrrd");
    EXPECT_EQ(lumenBeside("/a/b.1.nii.gz"), "/a/b.1_lumen.nrrd");
    const fs::path folder = fs::temp_directory_path() / "stereonav-1.2.840";
    fs::create_directories(folder);
    const fs::path expected = fs::temp_directory_path() / "stereonav-1.2.840_lumen.nrrd";
    EXPECT_EQ(lumenBeside(folder), expected);
    EXPECT_EQ(lumenBeside(folder / ""), expected);
    EXPECT_EQ(lumenBeside(folder / "."), expected);
    fs::remove(folder);
}

// What was kept must lie on the study's own grid and below the wall's value in it.
TEST(RestoreLumen, RefusesWhatDoesNotFit) {
    const GreyVolume& scan = tubeScan();
    Progress progress;
    const LumenField found = segmentColon(scan, {}, progress);
    const auto copyOf = [&] {
        MaskVolume mask(found.lumen.frame);
        std::memcpy(mask.values.data(), found.lumen.values.data(), mask.frame.count());
        return mask;
    };
    ASSERT_TRUE(restoreLumen(scan, copyOf(), {}));
    MaskVolume shifted = copyOf(), stretched = copyOf(), grown = copyOf(), gap = copyOf();
    shifted.frame.origin.x += 0.3 * scan.frame.spacing.x;
    stretched.frame.spacing.y *= 1.01;
    grown.at(grown.frame.size / 2 + glm::ivec3(13, 0, 0)) = 1;               // tissue beside the tube
    for (std::size_t n = 0; n < gap.frame.count(); ++n) gap.values[n] *= 2;  // no segment 1
    EXPECT_FALSE(restoreLumen(scan, std::move(shifted), {}));
    EXPECT_FALSE(restoreLumen(scan, std::move(stretched), {}));
    EXPECT_FALSE(restoreLumen(scan, std::move(grown), {}));
    EXPECT_FALSE(restoreLumen(scan, std::move(gap), {}));
    EXPECT_FALSE(restoreLumen(scan, MaskVolume(found.lumen.frame), {}));
}

}  // namespace
}  // namespace stereonav
