// The lumen beside the study: written once, read back instead of being found again, and told from files that
// are another's, outdated or damaged.
#include "colon/saved_lumen.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "colon/colon_scene.h"
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
        chmod((mFolder / "studies").c_str(), 0700);
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
    EXPECT_THAT(first.notes, Contains("lumen saved as " + beside().string()));
    EXPECT_THAT(first.notes, Contains(HasSubstr("1 pool(s) of tagged fluid")));
    const std::string header = test::fileBytes(beside()).substr(0, 1000);
    EXPECT_THAT(header, HasSubstr("\nencoding: gzip\n"));
    EXPECT_THAT(header, HasSubstr("\nstereonav lumen key:="));
    const auto written = fs::last_write_time(beside());
    const ColonScene again = open(file);
    EXPECT_THAT(again.notes, Contains("lumen read back from " + beside().string()));
    EXPECT_THAT(again.notes, Not(Contains(HasSubstr("saved as"))));
    EXPECT_EQ(fs::last_write_time(beside()), written);
    expectSameLumen(again, first);
}

TEST_F(SavedLumenTest, OtherSettingsAreOtherLumens) {
    const fs::path file = study();
    open(file);
    const ColonScene other = open(file, -500);
    EXPECT_THAT(other.notes, Contains(beside().string() + " is of another study or other settings"));
    EXPECT_THAT(other.notes, Contains("lumen saved as " + beside().string()));
    EXPECT_THAT(open(file, -500).notes, Contains(HasSubstr("read back")));
    SegmentationSetting a, b;
    b.seeds = {{0, 0, 0.1}};
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(1, b));
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(2, a));
    b = {};
    b.tagged = 250;
    EXPECT_NE(savedLumenKey(1, a), savedLumenKey(1, b));
}

TEST_F(SavedLumenTest, AnyDamageIsNamedAndMended) {
    const fs::path file = study();
    const ColonScene good = open(file);
    const std::string bytes = test::fileBytes(beside());
    std::string flipped = bytes, cut = bytes.substr(0, bytes.size() - 40), other = bytes;
    flipped[bytes.size() - 200] ^= 0x10;
    const std::size_t at = other.find("lumen hash:=") + 12;
    other[at] = other[at] == '0' ? '1' : '0';
    std::string moved = bytes;
    moved.replace(moved.find("space origin: ("), 15, "space origin: (9");
    std::string small = bytes;
    small.replace(small.find("sizes: "), 8, "sizes: 1");
    for (const std::string& damaged : {flipped, cut, other, moved, small}) {
        test::writeBytes(beside(), damaged);
        const ColonScene scene = open(file);
        EXPECT_THAT(scene.notes, Contains(HasSubstr("the lumen is found again")));
        EXPECT_THAT(scene.notes, Contains("lumen saved as " + beside().string()));
        expectSameLumen(scene, good);
        EXPECT_EQ(test::fileBytes(beside()), bytes);
    }
}

TEST_F(SavedLumenTest, FilesOfOthersAreLeftAlone) {
    const fs::path file = study();
    for (const std::string foreign :
         {"", "a diary", "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 1 1 1\n\n0"}) {
        test::writeBytes(beside(), foreign);
        const ColonScene scene = open(file);
        EXPECT_THAT(scene.notes, Contains(HasSubstr(beside().string() + " is not a lumen kept by this")));
        EXPECT_EQ(test::fileBytes(beside()), foreign);
    }
    // It went to the cache, from where it is read back.
    EXPECT_THAT(open(file).notes, Contains(HasSubstr("lumen read back from " + cacheFolder().string())));
}

// A name that leaves no room for "_lumen" is refused by the file system, for the superuser too.
TEST_F(SavedLumenTest, GoesToTheCacheWhereTheFolderCanNotBeWritten) {
    const fs::path file = study(std::string(245, 'x') + ".nrrd");
    const ColonScene first = open(file);
    EXPECT_THAT(first.notes,
                Contains(HasSubstr("can not be written: lumen saved as " + cacheFolder().string())));
    EXPECT_EQ(std::distance(fs::directory_iterator(mFolder / "studies"), fs::directory_iterator()), 1);
    const ColonScene again = open(file);
    EXPECT_THAT(again.notes, Contains(HasSubstr("lumen read back from " + cacheFolder().string())));
    expectSameLumen(again, first);
}

// The superuser is not held up by permissions, so it becomes nobody for a while.
class AsNobody {
public:
    AsNobody() : mWas(geteuid()) {
        if (mWas == 0 && seteuid(kNobody) != 0) return;
    }
    ~AsNobody() {
        if (geteuid() != mWas && seteuid(mWas) != 0) std::abort();
    }
    static constexpr uid_t kNobody = 65534;

private:
    uid_t mWas;
};

TEST_F(SavedLumenTest, GoesToTheCacheOfAReadOnlyFolder) {
    const fs::path file = study();
    fs::create_directories(cacheFolder());
    for (const fs::path& folder : {mFolder / "cache", cacheFolder()})
        if (geteuid() == 0 && chown(folder.c_str(), AsNobody::kNobody, AsNobody::kNobody) != 0)
            GTEST_SKIP() << "folders can not be given away here";
    chmod(mFolder.c_str(), 0755);
    chmod((mFolder / "studies").c_str(), 0555);
    const AsNobody nobody;
    if (eaccess((mFolder / "studies").c_str(), W_OK) == 0) GTEST_SKIP() << "permissions do not hold here";
    const ColonScene first = open(file), again = open(file);
    EXPECT_THAT(first.notes, Contains(HasSubstr("can not be written: lumen saved as")));
    EXPECT_THAT(again.notes, Contains(HasSubstr("lumen read back from " + cacheFolder().string())));
    expectSameLumen(again, first);
}

TEST_F(SavedLumenTest, SaysSoWhereItCanNotBeKeptAtAll) {
    const fs::path file = study(std::string(245, 'x') + ".nrrd");
    test::writeBytes(mFolder / "cache", "a file where the cache's folder should be");
    EXPECT_THAT(open(file).notes, Contains(HasSubstr("the lumen could not be saved: neither ")));
}

TEST_F(SavedLumenTest, NothingIsKeptWithoutTheCache) {
    ColonOptions options;
    options.study = study();
    options.cache = false;
    Progress progress;
    const ColonScene scene = loadColon(options, progress);
    EXPECT_TRUE(scene.isColon());
    EXPECT_FALSE(fs::exists(beside()));
    EXPECT_FALSE(fs::exists(mFolder / "cache"));
}

TEST(SavedLumen, LiesBesideTheStudy) {
    EXPECT_EQ(savedLumenFile("/a/b.nrrd"), "/a/b_lumen.nrrd");
    EXPECT_EQ(savedLumenFile("/a/b.1.nii.gz"), "/a/b.1_lumen.nrrd");
    const fs::path folder = fs::temp_directory_path() / "stereonav-1.2.840";
    fs::create_directories(folder);
    const fs::path expected = fs::temp_directory_path() / "stereonav-1.2.840_lumen.nrrd";
    EXPECT_EQ(savedLumenFile(folder), expected);
    EXPECT_EQ(savedLumenFile(folder / ""), expected);
    EXPECT_EQ(savedLumenFile(folder / "."), expected);
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
