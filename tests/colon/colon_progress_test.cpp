// Every function of studies and colons that takes a Progress tells all of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "colon/built_in/built_in_colon.h"
#include "colon/centreline/centreline.h"
#include "colon/instruments/candidates.h"
#include "colon/instruments/coverage.h"
#include "colon/instruments/finding.h"
#include "colon/instruments/panorama.h"
#include "colon/instruments/shared_wall.h"
#include "colon/instruments/unfolding.h"
#include "colon/scene/colon_scene.h"
#include "colon/scene/isosurface_scene.h"
#include "colon/scene/saved_lumen.h"
#include "colon/segmentation/lumen_surface.h"
#include "colon/segmentation/segmentation.h"
#include "colon/segmentation/segmentation_air.h"
#include "colon/study/study_header.h"
#include "colon/study/study_parts.h"
#include "engine/volume/components.h"
#include "engine/volume/distance_transform.h"
#include "study_dicom_slices.h"
#include "study_ramp.h"
#include "tests/camera/temporary_folder.h"
#include "tests/colon/lumen_wall.h"
#include "tests/support/analytic_lumen.h"
#include "tests/support/made_ct.h"
#include "tests/support/thread_peers.h"
#include "tests/support/volume_files.h"
#include "tests/support/whole_progress.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

const LumenWall& shortTube() {
    static const LumenWall wall([](const glm::dvec3& p) { return toTube(p, 0.01, -0.03, 0.03); },
                                {-0.013, -0.013, -0.033}, {0.013, 0.013, 0.033}, 0.001);
    return wall;
}
Centreline tubeAxis() {
    return lineThrough({{0, 0, -0.025}, {0, 0, 0.025}}, 0.01);
}

class ColonProgress : public testing::Test {
protected:
    void SetUp() override {
        if (const char* const before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
    }

    TemporaryFolder mFolder;
    std::string mBefore;
};

TEST_F(ColonProgress, IsWholeOfVolumeFiles) {
    const std::string bytes(reinterpret_cast<const char*>(ramp<short>().data()), 2 * ramp<short>().size());
    std::string text, hex;
    for (const short value : ramp<short>()) text += fmt::format("{} ", value);
    for (const char byte : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    const auto encoded = [](const char* how) { return replaced(kShortLines, "encoding: raw", how); };
    for (const fs::path& file :
         {writeNrrd(mFolder / "raw.nrrd", kShortLines, bytes),
          writeNrrd(mFolder / "gzip.nrrd", encoded("encoding: gzip"), gzipped(bytes)),
          writeNrrd(mFolder / "text.nrrd", encoded("encoding: ascii"), text),
          writeNrrd(mFolder / "hex.nrrd", encoded("encoding: hex"), hex),
          writeNrrd(mFolder / "sheared.nrrd", replaced(kShortLines, "(0,0,2)", "(0,0.4,2)"), bytes)}) {
        SCOPED_TRACE(file);
        StudyOptions options;
        options.resample = true;
        expectWholeProgress("a file", 1,
                            [&](Progress& progress) { readVolumeFile(file, options, progress); });
        expectWholeProgress("a study", 2, [&](Progress& progress) { readStudy(file, options, progress); });
        expectWholeProgress("a glance", 0, [&](Progress& progress) { glanceAtStudy(file, progress); });
        const VolumeHeader header = readVolumeHeader(file);
        expectWholeProgress("samples", 0, [&](Progress& progress) {
            std::vector<unsigned char> samples(bytes.size());
            readSamples(file, header, samples.data(), progress, [](std::uint64_t) {});
        });
    }
}

// Slices that are upright or sheared, and of values that are no whole numbers, which are read twice.
TEST_F(ColonProgress, IsWholeOfSlices) {
    for (const char* const kind : {"upright", "sheared", "fractions"}) {
        const fs::path folder = mFolder / kind;
        fs::create_directories(folder);
        for (int k = 0; k < kSlices; ++k) {
            DicomSpec s = specOf(k);
            if (kind == std::string("sheared")) s.slice.position.y += 0.4 * k;
            if (kind == std::string("fractions")) s.slice.slope = "0.001", s.slice.modality = "MR";
            writeDicom(folder / fmt::format("s{}.dcm", k), s);
        }
        StudyOptions options;
        options.resample = true;
        expectWholeProgress(kind, 3, [&](Progress& progress) { readDicom(folder, options, progress); });
        expectWholeProgress(kind, 4, [&](Progress& progress) { readStudy(folder, options, progress); });
        expectWholeProgress(kind, 2, [&](Progress& progress) { glanceAtSlices(folder, progress); });
        expectWholeProgress(kind, 2, [&](Progress& progress) { glanceAtStudy(folder, progress); });
    }
}

// A colon as it is opened first, from the cache with its study and without, and as a surface: each stage
// begins where the one before it has ended.
TEST_F(ColonProgress, IsWholeOfColonsThatAreOpened) {
    const GreyVolume scan = scanned(filled({100, 100, 90}, 0.0012, TubeBody::hu), 0.0008, 15);
    ColonOptions options;
    options.study =
        writeNrrd(mFolder / "tube.nrrd",
                  "type: short\ndimension: 3\nsizes: 100 100 90\nspace: left-posterior-superior\n"
                  "space directions: (1.2,0,0) (0,1.2,0) (0,0,1.2)\nspace origin: (0,0,0)\nencoding: raw\n"
                  "endian: little\n",
                  std::string(reinterpret_cast<const char*>(scan.values.data()), 2 * scan.frame.count()));
    Progress quiet;
    ASSERT_TRUE(loadColon(options, quiet).isColon());
    const auto load = [&](Progress& progress) { loadColon(options, progress); };
    expectWholeProgress("a new colon", 5,
                        [&](Progress& progress) {
                            fs::remove_all(mFolder / "cache");
                            loadColon(options, progress);
                        },
                        {0.5, 0.5 + 0.4 * 0.7, 0.9});
    loadColon(options, quiet);
    expectWholeProgress("from the cache", 1, load);
    options.keepsStudy = true;
    expectWholeProgress("from the cache, with its study", 2, load, {0.5});
    options.isosurface = true;
    expectWholeProgress("a surface", 2, load, {0.5});
}

TEST_F(ColonProgress, IsWholeOfCandidates) {
    const LumenWall wall(
        [](const glm::dvec3& p) {
            return std::max(toTube(p, 0.014, -0.02, 0.02), -toBall(p, {0.012, 0, 0}, 0.005));
        },
        {-0.017, -0.017, -0.023}, {0.017, 0.017, 0.023}, 0.0007);
    expectWholeProgress("candidates", 0, [&](Progress& progress) {
        EXPECT_FALSE(polypCandidates(wall.mesh, wall.neighbours, {}, &progress).empty());
    });
    expectWholeProgress("none", 0, [&](Progress& progress) {
        polypCandidates(shortTube().mesh, shortTube().neighbours, {}, &progress);
    });
}

TEST_F(ColonProgress, IsWholeOfCoverage) {
    const LumenWall& tube = shortTube();
    const LineOfSight sight = tube.sight();
    const std::vector<Pose> poses{lookingAlong({0, 0, -0.02}, {0, 0, 1}), lookingAlong({0, 0, 0}, {0, 1, 0})};
    Coverage coverage(tube.mesh, tube.neighbours, sight, {});
    for (const std::size_t count : {std::size_t{1}, poses.size(), std::size_t{0}})
        expectWholeProgress("looking", 5, [&](Progress& progress) {
            coverage.look(std::span(poses).first(count), progress);
        });
    const auto freeDistance = [&](const glm::dvec3& p, double upTo) { return tube.freeDistanceAt(p, upTo); };
    std::vector<UnseenPatch> patches = coverage.patches(freeDistance, 0.001);
    ASSERT_FALSE(patches.empty());
    while (patches.size() < 3) patches.push_back(patches.front());
    expectWholeProgress("visiting", 2,
                        [&](Progress& progress) { coverage.visit(patches, freeDistance, 0.001, progress); });
    expectWholeProgress("nothing to visit", 0,
                        [&](Progress& progress) { coverage.visit({}, freeDistance, 0.001, progress); });
    runAsPeers(2, [&](Peers& peers) {
        Coverage shared(tube.mesh, tube.neighbours, sight, {});
        shared.shareWith(peers);
        WrittenProgress written;
        shared.look(std::span(poses), written.progress());
        if (peers.first()) written.expectWhole("looking together", 2);
    });
}

TEST_F(ColonProgress, IsWholeOfFlatPictures) {
    const LumenWall wall(
        [](const glm::dvec3& p) {
            return toBall(p, {0, 0, std::clamp(p.z, -0.03, 0.03)}, 0.01);
        },
        {-0.013, -0.013, -0.043}, {0.013, 0.013, 0.043}, 0.001);
    const LineOfSight sight = wall.sight();
    const Centreline line = tubeAxis();
    expectWholeProgress("unfolding", 4, [&](Progress& progress) {
        UnfoldedWall(wall.mesh, wall.neighbours, line, sight, {}, progress);
    });
    Progress quiet;
    expectWholeProgress("a panorama's place", 0, [&](Progress& progress) {
        Panorama(wall.lumen.field, line, sight, 0.001, progress);
    });
    const Panorama panorama(wall.lumen.field, line, sight, 0.001, quiet);
    expectWholeProgress("a panorama", 10, [&](Progress& progress) { panorama.picture({}, progress); });
    expectWholeProgress("what it shows", 1,
                        [&](Progress& progress) { panorama.shares(wall.mesh, progress); });
}

}  // namespace
}  // namespace stereonav::test
