// The keys of what is kept of studies: whatever changes what is found gives another key, and what is a matter
// of looks does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "colon/scene/colon_cache.h"
#include "colon/scene/saved_lumen.h"
#include "colon/study/dicom_uid.h"
#include "study_ramp.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/each_member.h"
#include "tests/support/volume_files.h"

namespace stereonav::test {

template <>
struct Members<BuiltInColonSetting> {
    static constexpr std::array names{"seed", "size", "bend", "inflation"};
};
template <>
struct Members<StudyOptions> {
    static constexpr std::array names{"series", "resample", "label", "key", "airBelow", "working"};
};
template <>
struct Members<PieceChoices> {
    static constexpr std::array names{"include", "exclude"};
};
template <>
struct Members<SegmentationSetting> {
    static constexpr std::array names{"air",     "tagged",      "wall",         "seeds",
                                      "choices", "leavesFluid", "maskSmoothing"};
};
template <>
struct Members<CentrelineSetting> {
    static constexpr std::array names{"spacing", "reversed", "mostUneven"};
};
template <>
struct Members<UpAxis> {
    static constexpr std::array names{"axis", "negative"};
};
template <>
struct Members<ChosenForVolume> {
    static constexpr std::array names{"values", "baked", "view", "aspect", "fov"};
};
template <>
struct Members<ColonOptions> {
    static constexpr std::array names{"study",      "builtIn",  "reading",    "segmentation", "centreline",
                                      "isosurface", "isovalue", "transfer",   "opacity",      "clearance",
                                      "up",         "cache",    "keepsStudy", "chosen",       "wetWall"};
};

namespace {

// These tell which study it is, whose key counts by itself.
const std::vector<std::string> kOfStudy{"study", "builtIn", "reading"};
// How it is shown, and what is held of it.
const std::vector<std::string> kOfLooks{"isosurface", "isovalue", "transfer",   "opacity", "clearance",
                                        "up",         "cache",    "keepsStudy", "chosen",  "wetWall"};

std::vector<std::string> with(std::vector<std::string> names, const std::vector<std::string>& others) {
    names.insert(names.end(), others.begin(), others.end());
    return names;
}

SegmentationSetting seeded(std::size_t seeds) {
    SegmentationSetting setting;
    for (std::size_t n = 0; n < seeds; ++n) setting.seeds.push_back({0.1, 0.02, 0.003 * double(n)});
    return setting;
}

TEST(ColonKey, HasEverySettingOfWhatIsFound) {
    for (const std::size_t seeds : {0, 1, 2}) {
        ColonOptions base;
        base.segmentation = seeded(seeds);
        expectKeysDiffer(base, eachMemberChanged(base, with(kOfStudy, kOfLooks)),
                         [](const ColonOptions& o) { return colonCacheKey(1, o); });
    }
}

TEST(ColonKey, IsThatOfAColonThatLooksOtherwise) {
    const ColonOptions base;
    expectKeysEqual(base, eachMemberChanged(base, with(kOfStudy, {"segmentation", "centreline"})),
                    [](const ColonOptions& o) { return colonCacheKey(1, o); });
}

TEST(ColonKey, HasTheStudy) {
    const std::uint64_t base = 0x1234567890abcdef;
    std::vector<Changed<std::uint64_t>> others;
    for (int bit = 0; bit < 64; ++bit) others.push_back({std::to_string(bit), base ^ 1ull << bit});
    expectKeysDiffer(base, others, [](std::uint64_t study) { return colonCacheKey(study, {}); });
    expectKeysDiffer(base, others, [](std::uint64_t study) { return savedLumenKey(study, {}); });
}

TEST(ColonKey, OfALumenHasEverySettingOfTheSegmentation) {
    for (const std::size_t seeds : {0, 1, 2}) {
        const SegmentationSetting base = seeded(seeds);
        // A lumen is kept of grey values alone, which are not smoothed.
        expectKeysDiffer(base, eachMemberChanged(base, {"maskSmoothing"}),
                         [](const SegmentationSetting& s) { return savedLumenKey(1, s); });
    }
}

TEST(ColonKey, OfTheBuiltInColonHasEverySetting) {
    const BuiltInColonSetting usual;
    BuiltInColonSetting another;
    another.bend = 0.01;
    another.inflation = 1.25;
    for (const BuiltInColonSetting& base : {usual, another})
        expectKeysDiffer(base, eachMemberChanged(base), builtInColonKey);
}

// Which series it is tells what files are read, whose bytes count. Nothing else of how it is read changes the
// values: what is looked for and held beside them, and the key itself.
TEST(ColonKey, OfAStudyHasHowItIsRead) {
    const TemporaryFolder folder;
    const auto file = writeNrrd(folder / "a.nrrd", kShortLines, bytesOfSamples(ramp<short>()));
    const auto key = [&](const StudyOptions& options) { return studyKey(file, options); };
    StudyOptions labelled;
    labelled.label = "3";
    const StudyOptions plain;
    for (const StudyOptions& base : {plain, labelled}) {
        expectKeysDiffer(base, eachMemberChanged(base, {"series", "key", "airBelow", "working"}), key);
        std::vector<Changed<StudyOptions>> same =
            eachMemberChanged(base, {"series", "resample", "label", "working"});
        same.push_back({"working", base});
        same.back().value.working = [](double voxels) { return voxels; };
        expectKeysEqual(base, same, key);
    }
}

// Each byte of the header, the first ones of the samples and the last ones.
TEST(ColonKey, OfAStudyHasEveryByte) {
    const TemporaryFolder folder;
    const std::string samples = bytesOfSamples(ramp<short>());
    const auto keyOf = [&](const std::string& bytes) {
        return studyKey(writeNrrd(folder / "a.nrrd", kShortLines, bytes), {});
    };
    std::vector<Changed<std::string>> changes;
    for (std::size_t n = 0; n < samples.size(); n += n < 32 || n + 32 > samples.size() ? 1 : 13) {
        changes.push_back({"byte " + std::to_string(n), samples});
        changes.back().value[n] ^= 1;
    }
    changes.push_back({"two bytes exchanged", samples});
    std::swap(changes.back().value[2], changes.back().value[4]);
    expectKeysDiffer(samples, changes, keyOf);
}

TEST(ColonKey, OfSeveralFilesHasTheirOrder) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const auto file =
        writeNrrd(folder / "d.nhdr", kShortLines + "data file: LIST\na.raw\nb.raw\nc.raw\n", "");
    std::string names = "abc";
    std::set<std::uint64_t> keys;
    do {
        for (std::size_t k = 0; k < 3; ++k)
            writeBytes(folder / (std::string(1, names[k]) + ".raw"), bytes.substr(40 * k, 40));
        EXPECT_TRUE(keys.insert(studyKey(file, {})).second) << names;
    } while (std::next_permutation(names.begin(), names.end()));
    EXPECT_EQ(keys.size(), 6u);
}

TEST(ColonKey, OfAReportIsAnotherUidForAnotherText) {
    const std::string base = "study 1 series 2";
    std::vector<Changed<std::string>> changes;
    for (std::size_t n = 0; n < base.size(); ++n) {
        changes.push_back({std::to_string(n), base});
        changes.back().value[n] ^= 1;
    }
    changes.push_back({"longer", base + " "});
    changes.push_back({"nothing", ""});
    expectKeysDiffer(base, changes, [](const std::string& text) { return uidOfText(text); });
}

}  // namespace
}  // namespace stereonav::test
