// Every pair of what can be combined when a picture is drawn (every triple with STEREONAV_ALL_TRIPLES), drawn
// small and held against the plain kernels with the right eye cast in full (tests/combinations/bounds.h).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "app/command/arguments.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/image/image_file.h"
#include "engine/medium/sweep/medium_scene.h"
#include "tests/app/program.h"
#include "tests/combinations/bounds.h"
#include "tests/combinations/contact_sheet.h"
#include "tests/combinations/drawing.h"
#include "tests/combinations/figures.h"
#include "tests/combinations/inputs.h"
#include "tests/combinations/judging.h"
#include "tests/combinations/oracle.h"

namespace stereonav::test {
namespace {

// Returns the rows that a file names, a line each, as failures say them.
std::vector<Row> rowsOfFile(const std::string& file) {
    std::ifstream in(file);
    std::vector<Row> rows;
    for (std::string line; std::getline(in, line);)
        if (!line.empty()) rows.push_back(rowFrom(line));
    if (rows.empty()) throw std::runtime_error("no combination is named in " + file);
    return rows;
}

const std::vector<Row>& drawnRows() {
    static const std::vector<Row> rows = [] {
        if (const char* file = std::getenv("STEREONAV_COMBINATIONS")) return rowsOfFile(file);
        const Covering all = covering();
        return all.cover(wantedTuples(all, std::getenv("STEREONAV_ALL_TRIPLES") != nullptr),
                         kCombinationsSeed);
    }();
    return rows;
}

std::string asName(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return text;
}

class Combinations : public ProgramTest, public testing::WithParamInterface<std::string> {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
        std::filesystem::create_directory(mFolder / "inputs");
        mInputs = std::make_unique<Inputs>(mFolder / "inputs", [this](const Arguments& arguments) {
            const Outcome outcome = run(arguments);
            ASSERT_EQ(outcome.status, 0) << shellLine(arguments) << "\n" << outcome.err;
        });
    }
    // What a failure is reproduced with stays.
    void TearDown() override {
        setThreadCount(kUsualThreads);
        if (HasFailure()) {
            std::printf("inputs are left in %s\n", mFolder.c_str());
            return;
        }
        ProgramTest::TearDown();
    }

    static constexpr int kUsualThreads = 2;
    std::unique_ptr<Inputs> mInputs;
};

class Drawn {
public:
    Drawn(const Row& row, const Arguments& line)
        : mRow(row), mOptions(renderOptionsFrom({line.begin() + 1, line.end()})) {}

    void check() {
        Eyes plain;
        for (const SimdTarget set : simdTargets()) {
            Drawing drawing(mOptions, set);
            const Eyes full = drawing.inFull();
            mDrawn = drawing.eyes();
            const Eyes& drawn = mDrawn;
            if (set == SimdTarget::Plain) {
                plain = full;
                if (isShadedBetweenPlaces(mRow))
                    checkEachSample(full);
                else
                    checkOracle(drawing, full);
            }
            const std::string name(nameOf(set));
            if (drawing.notFinite() > 0)
                expect(std::to_string(drawing.notFinite()) + " pixels hold no number before they are packed",
                       name);
            for (const auto& [eyes, what] : {std::pair{&full, "in full"}, {&drawn, "by the method"}}) {
                expect(wrongNumbers(eyes->left), name + ", left eye " + what);
                expect(wrongNumbers(eyes->right), name + ", right eye " + what);
            }
            if (set != SimdTarget::Plain) {
                expectNear(full.left, plain.left, betweenSets(mRow), name + ", left eye beside plain");
                expectNear(full.right, plain.right, betweenSets(mRow), name + ", right eye beside plain");
            }
            Eyes smooth;
            if (drawing.edges().rays > 0) {
                smooth = drawing.inFullAndSmooth();
                checkSmooth(smooth, drawing.smoothedPlainly(full), name);
            }
            const Eyes& exact = drawing.edges().rays > 0 ? smooth : full;
            if (!isTimed(mRow)) expect(differentBits(drawn.left, exact.left), name + ", left eyes");
            checkRight(drawn.right, exact.right, full.right, name);
            if (!isTimed(mRow)) checkThreads(drawing, drawn, name);
        }
    }

    const std::string& findings() const { return mFindings; }
    // Returns the picture that the widest set drew.
    Plane<PackedColor> composed() const {
        return composeStereo(mDrawn.left.color, mDrawn.right.color, {mOptions.mode, false, false});
    }
    const Eyes& eyes() const { return mDrawn; }

private:
    void expect(const std::string& problem, const std::string& where) {
        if (!problem.empty()) mFindings += where + ": " + problem + "\n";
    }

    void expectNear(const EyeImage& image, const EyeImage& oracle, const Nearness& bound,
                    const std::string& what) {
        expect(tooFar(image, oracle, bound), what);
        const Nearness holds = nearnessThatHolds(image, oracle, bound.beyond);
        noteFigure(what, holds.steps, holds.mean, textOf(mRow));
    }
    void expectNear(const EyeImage& image, const OraclePicture& oracle, const std::string& what) {
        std::string problem;
        const EyeImage other = packed(oracle, problem);
        expect(problem, what);
        expectNear(image, other, besideOracle(mRow), what);
    }

    // The oracle stands for shading each sample, and that for shading between places.
    void checkEachSample(const Eyes& full) {
        RenderOptions options = mOptions;
        options.scene.medium.shadingWidth = 0;
        Drawing drawing(options, SimdTarget::Plain);
        const Eyes each = drawing.inFull();
        checkOracle(drawing, each);
        expectNear(full.left, each.left, besideEachSample(mRow), "left eye beside each sample");
        expectNear(full.right, each.right, besideEachSample(mRow), "right eye beside each sample");
    }

    // Plain kernels against double precision; other sets are held against plain kernels.
    void checkOracle(const Drawing& drawing, const Eyes& full) {
        const StereoViews views = drawing.views();
        if (isSeenOtherwiseByOracle(mRow)) return;
        if (const auto left = castByOracle(drawing.scene(), views.left)) {
            expectNear(full.left, *left, "left eye beside the oracle");
            expectNear(full.right, *castByOracle(drawing.scene(), views.right),
                       "right eye beside the oracle");
        }
        if (!drawing.scene().offered<MediumScene>()) return;
        const bool together = drawing.sweepsTogether();
        const std::vector<std::vector<EyeView>> sweeps =
            together ? std::vector<std::vector<EyeView>>{{views.left, views.right}}
                     : std::vector<std::vector<EyeView>>{{views.left}, {views.right}};
        std::vector<OraclePicture> eyes;
        for (const std::vector<EyeView>& sweep : sweeps)
            for (OraclePicture& eye : sweptByOracle(drawing.scene(), sweep)) eyes.push_back(std::move(eye));
        expectNear(full.left, eyes.at(0), "left eye beside the oracle");
        expectNear(full.right, eyes.at(1), "right eye beside the oracle");
    }

    void checkSmooth(const Eyes& smooth, const Eyes& plainly, const std::string& name) {
        expect(wrongNumbers(smooth.left), name + ", left eye with rays at edges");
        expect(wrongNumbers(smooth.right), name + ", right eye with rays at edges");
        expectNear(smooth.left, plainly.left, besidePlainEdges(mRow), name + ", edges of the left eye");
        expectNear(smooth.right, plainly.right, besidePlainEdges(mRow), name + ", edges of the right eye");
    }

    // plain: full without rays at edges.
    void checkRight(const EyeImage& right, const EyeImage& full, const EyeImage& plain,
                    const std::string& name) {
        if (const auto range = rangeOfRight(mRow)) {
            const Oracles oracles{full, edgesDecideColours(mRow) ? plain : full};
            expect(outOfRange(right, oracles, *range), name + ", right eye beside the full one");
            noteFigure(name + ", right eye in range", rangeThatHolds(right, oracles, *range).steps, 0,
                       textOf(mRow));
            expect(strangeFlatness(right, full, range->reach, range->beyond), name + ", right eye");
        }
        if (const auto bound = nearnessOfRight(mRow))
            expect(tooFar(right, full, *bound), name + ", right eye beside the full one");
    }

    void checkThreads(Drawing& drawing, const Eyes& drawn, const std::string& name) {
        const int threads = threadCount();
        setThreadCount(threads == 1 ? 3 : 1);
        const Eyes others = drawing.eyes();
        setThreadCount(threads);
        expect(differentBits(others.left, drawn.left), name + ", left eye by other threads");
        expect(differentBits(others.right, drawn.right), name + ", right eye by other threads");
    }

    const Row& mRow;
    RenderOptions mOptions;
    Eyes mDrawn;
    std::string mFindings;
};

// The real program writes the same picture, and nothing else.
std::string programDraws(const Outcome& outcome, const std::filesystem::path& place,
                         const Plane<PackedColor>& picture) {
    if (outcome.status != 0)
        return "the program ends with " + std::to_string(outcome.status) + ": " + outcome.err;
    if (!outcome.err.empty()) return "the program says " + outcome.err;
    std::string problem;
    for (const auto& entry : std::filesystem::directory_iterator(place))
        if (entry.path().filename() != "picture.png")
            problem += "the program left " + entry.path().string() + "\n";
    const std::vector<unsigned char> bytes = encodeColorImage(picture, ".png");
    if (contentOf(place / "picture.png") != std::string(bytes.begin(), bytes.end()))
        problem += "the program draws another picture\n";
    std::filesystem::remove(place / "picture.png");
    return problem;
}

TEST_P(Combinations, AreDrawnAsByThePlainOracle) {
    constexpr int kEach = 6;  // every sixth is drawn by the real program, too
    int drawn = 0;
    ContactSheet sheet(asName(GetParam()));
    for (const Row& row : drawnRows()) {
        if (levelOf(row, Factor::Scene) != GetParam()) continue;
        const Arguments line = mInputs->commandLine(row);
        setThreadCount(kUsualThreads);
        std::string findings;
        const Stopwatch watch;
        try {
            Drawn one(row, line);
            one.check();
            findings = one.findings();
            if (drawn % kEach == 0 && !isDrawnOnceOnly(row))
                findings += programDraws(run(line), place(), one.composed());
            sheet.add(one.eyes().left.color, one.eyes().right.color);
        } catch (const std::exception& error) {
            findings = std::string("refused: ") + error.what() + "\n";
        }
        noteFigure("milliseconds", static_cast<int>(watch.elapsed_ms()), 0, textOf(row));
        if (!findings.empty()) ADD_FAILURE() << textOf(row) << "\n  " << shellLine(line) << "\n" << findings;
        ++drawn;
    }
    std::printf("%d combinations of %s drawn\n", drawn, GetParam().c_str());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Combinations,
                         testing::ValuesIn(factorTable()[static_cast<std::size_t>(Factor::Scene)].levels),
                         [](const testing::TestParamInfo<std::string>& scene) {
                             return asName(scene.param);
                         });

}  // namespace
}  // namespace stereonav::test
