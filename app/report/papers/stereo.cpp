// Wan et al. 2004 beside this program: Tables 1 and 2, the figures of section 5 and the partitions of section
// 3.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <iterator>

#include "app/report/papers/data.h"
#include "app/report/papers/run.h"
#include "app/report/stereo_trial.h"
#include "engine/simd/simd_target.h"

namespace stereonav {
namespace {

constexpr const char* kWan = "Wan et al. 2004";
constexpr int kFigureWidth = 500, kFigureHeight = 400;  // figs. 6 and 7

// The paper's times in seconds by number of processors (Table 2).
struct PaperTimes {
    std::string figure;
    std::array<double, 5> left, right;  // with 1, 4, 8, 12 and 16 processors
    double saved_percent;               // from section 5
};
constexpr std::array<int, 5> kProcessors{1, 4, 8, 12, 16};
const PaperTimes kShaded{
    "fig. 6, shaded", {3.21, 0.85, 0.44, 0.33, 0.23}, {0.38, 0.10, 0.06, 0.04, 0.03}, 88};
const PaperTimes kPhoto{
    "fig. 7, with its photo", {0.97, 0.27, 0.14, 0.11, 0.07}, {0.32, 0.09, 0.05, 0.04, 0.03}, 65};

constexpr const char* kWhyTimes =
    "Theirs: 194 MHz R10000, ground of 512x512 samples met at equal steps. Ours: exact hits, found through a "
    "pyramid of heights and from the ray below, many rays in a vector.";
constexpr const char* kWhySaved =
    "Casting the whole picture is so cheap here that the warp weighs more beside it: the less a ray costs, "
    "the less the second eye can save.";
constexpr const char* kWhyHoles =
    "Another view of other ground, and a mean of frames; counted as there, without the sky.";

enum Way : std::size_t {
    kAsThere,      // the paper's reconstruction and partitions
    kAlone,        // the same, with holes without coherence
    kInterleaved,  // the same, with interleaved rows
    kWarpDynamic,
    kFillStatic,  // the same, with holes in static partitions
    kFillInterleaved,
    kLeftDynamic,
    kOwn,  // default of the program
};

StereoWay paperWay(const std::string& name, Schedule left, Schedule warp, Schedule fill) {
    StereoWay way{name, {}, left, true};
    way.setting.method = RightEyeMethod::Paper;
    way.setting.warpSchedule = warp;
    way.setting.fillSchedule = fill;
    return way;
}

std::vector<StereoWay> terrainWays(const Scene& scene) {
    using S = Schedule;
    std::vector<StereoWay> ways{paperWay("as there", S::Interleaved, S::Contiguous, S::Dynamic),
                                paperWay("without coherence", S::Interleaved, S::Contiguous, S::Dynamic),
                                paperWay("warp interleaved", S::Interleaved, S::Interleaved, S::Dynamic),
                                paperWay("warp dynamic", S::Interleaved, S::Dynamic, S::Dynamic),
                                paperWay("holes contiguous", S::Interleaved, S::Contiguous, S::Contiguous),
                                paperWay("holes interleaved", S::Interleaved, S::Contiguous, S::Interleaved),
                                paperWay("left eye dynamic", S::Dynamic, S::Contiguous, S::Dynamic),
                                {"default", {}, S::Dynamic, true}};
    ways[kAlone].coherent = false;
    ways[kOwn].setting.method = defaultMethodFor(rendererOf(scene));
    return ways;
}

Spread ratioOf(const Spread& a, const Spread& b) {
    return b.low > 0 ? exactly(a.low / b.low) : Spread{};
}

Spread savedOf(const StereoTimes& t) {
    return t.left.low > 0 ? exactly(100 * (1 - t.right.low / t.left.low)) : Spread{};
}

std::string tooFew(int all) {
    return fmt::format("this machine runs {} thread{}", all, all == 1 ? "" : "s");
}

class StereoTables {
public:
    StereoTables(ReportRun& run, const PaperTimes& theirs, const Scene& scene, const std::string& title)
        : mRun(run),
          mTheirs(theirs),
          mAll(threadCount()),
          mTrial(scene, terrainWays(scene), run.pick(2, 8)),
          mMeasured(fmt::format("{}, {}x{}, mean of {} frames of its flight", title, scene.lens.width,
                                scene.lens.height, mTrial.frames())) {}

    std::vector<PaperRow> rows(double seconds) {
        mTrial.time(mRun, "stereo, " + mTheirs.figure, paperThreads(mAll), mRun.pick(2, 3), mRun.pick(3, 12),
                    seconds);
        mRun.tell("stereo, counts");
        mAsThere = mTrial.counts(kAsThere);
        mOwn = mTrial.counts(kOwn);
        addAlgorithm();
        addTimes();
        addSection5();
        addPartitions();
        return {std::make_move_iterator(mRows.begin()), std::make_move_iterator(mRows.end())};
    }

private:
    PaperRow& add(const char* table, const std::string& row, const std::string& column, Spread ours,
                  const char* unit, const char* why) {
        mRows.push_back({.paper = kWan,
                         .table = table,
                         .row = fmt::format("{} ({})", row, mTheirs.figure),
                         .column = column,
                         .ours = ours,
                         .unit = unit,
                         .measured = mMeasured,
                         .why = why});
        return mRows.back();
    }

    // Adds Table 1, the serial algorithm, which has no figures: shares of pixels that its lines fill.
    void addAlgorithm() {
        const auto holes = static_cast<double>(std::max(mAsThere.holePixels, 1ll));
        const std::pair<const char*, double> gaps[] = {
            {"fill gap between [P_r, D]: right-end gap", mAsThere.rightEnd},
            {"fill gap between [P_r, P_s]: middle gaps", mAsThere.middle},
            {"fill gap between [C, P_s]: left-end gap", mAsThere.leftEnd}};
        for (const auto& [name, pixels] : gaps)
            add("Table 1", name, "share of the holes", exactly(100 * pixels / holes), "%",
                "Table 1 lists the algorithm and has no figures. Here the head lies midway between the eyes, "
                "there it is the left eye: what lies nearer than zero parallax opens the right end, what "
                "lies beyond it the left one.")
                .said = pixels == mAsThere.rightEnd ? "most, in a few columns (section 3.3)" : "no figure";
    }

    void addTimes() {
        std::vector<int> columns(kProcessors.begin(), kProcessors.end());
        for (const int n : paperThreads(mAll))
            if (std::find(columns.begin(), columns.end(), n) == columns.end()) columns.push_back(n);
        std::sort(columns.begin(), columns.end());
        const auto line = [&](const char* name, const std::array<double, 5>& theirs, const auto& timeOf) {
            for (const int n : columns) {
                const bool has = n <= mAll;
                const auto at = std::find(kProcessors.begin(), kProcessors.end(), n);
                PaperRow& row = add("Table 2", name, fmt::format("{} processor{}", n, n == 1 ? "" : "s"),
                                    has ? scaled(timeOf(n), 1e-3) : Spread{}, "s", kWhyTimes);
                row.kind = PaperRow::Kind::Time;
                if (!has) row.none = tooFew(mAll);
                if (at == kProcessors.end())
                    row.said = "-";
                else
                    row.theirs = theirs[static_cast<std::size_t>(at - kProcessors.begin())];
            }
        };
        line("left image, static partition", mTheirs.left,
             [&](int n) { return mTrial.times(n, kAsThere).left; });
        line("left image, dynamic", mTheirs.left, [&](int n) { return mTrial.times(n, kLeftDynamic).left; });
        line("right image, their way and partitions", mTheirs.right,
             [&](int n) { return mTrial.times(n, kAsThere).right; });
        line("right image, the default way", mTheirs.right,
             [&](int n) { return mTrial.times(n, kOwn).right; });
        const int most = paperThreads(mAll).back();
        const auto speedup = [&](const char* name, const std::array<double, 5>& theirs, const auto& timeOf) {
            PaperRow& row = add("Table 2", name, fmt::format("1 to 16 processors there, 1 to {} here", most),
                                ratioOf(timeOf(1), timeOf(most)), "times as fast",
                                "On as many processors as each machine has.");
            row.theirs = theirs.front() / theirs.back();
        };
        speedup("speed-up of the left image", mTheirs.left,
                [&](int n) { return mTrial.times(n, kAsThere).left; });
        speedup("speed-up of the right image", mTheirs.right,
                [&](int n) { return mTrial.times(n, kAsThere).right; });
    }

    void addSection5() {
        constexpr const char* kTable = "Section 5";
        const StereoTimes &there = mTrial.times(1, kAsThere), &alone = mTrial.times(1, kAlone),
                          &own = mTrial.times(1, kOwn);
        const bool shaded = &mTheirs == &kShaded;
        const auto holes = [&](const char* name, const StereoCounts& counts, const char* why) {
            PaperRow& row = add(kTable, "hole pixels of warped ones", name,
                                exactly(counts.holesOfWarped_percent()), "%", why);
            if (shaded)
                row.theirs = 2.6;
            else
                row.said = "no figure";
        };
        holes("their way", mAsThere, kWhyHoles);
        holes("the default way", mOwn,
              "The default resamples between neighbours and casts where they shift apart: more holes, less "
              "error.");
        PaperRow& fill = add(kTable, "hole filling of the right image's time", "1 processor",
                             exactly(100 * there.fill.low / std::max(there.right.low, 1e-9)), "%",
                             "Their scene has no sky to cast; here it is most of the holes.");
        PaperRow& slow = add(kTable, "hole filling without ray coherence", "1 processor",
                             ratioOf(alone.fill, there.fill), "times the time",
                             "Here a ray without coherence still leaps by the pyramid of heights, which "
                             "theirs had not: there is less to gain. Rate without: the reciprocal.");
        if (shaded)
            fill.theirs = 25, slow.theirs = 4;
        else
            fill.said = slow.said = "no figure";
        add(kTable, "saved on the right image against the left", "their way", savedOf(there), "%", kWhySaved)
            .theirs = mTheirs.saved_percent;
        add(kTable, "saved on the right image against the left", "the default way", savedOf(own), "%",
            kWhySaved)
            .theirs = mTheirs.saved_percent;
        add(kTable, "PSNR of the right image against a full cast", "their way", exactly(mAsThere.psnr_db()),
            "dB", "Counted without the sky, which both cast.")
            .said = "the differences are small (fig. 6e)";
        add(kTable, "PSNR of the right image against a full cast", "the default way", exactly(mOwn.psnr_db()),
            "dB", "Counted without the sky.")
            .said = "the differences are small (fig. 6e)";
        const int most = paperThreads(mAll).back();
        const StereoTimes& all = mTrial.times(most, kAsThere);
        PaperRow& pairs =
            add(kTable, "stereo pairs a second", fmt::format("16 processors there, {} here", most),
                exactly(1000 / std::max(all.left.low + all.right.low, 1e-9)), "Hz", kWhyTimes);
        if (shaded)
            pairs.said = "no figure";
        else
            pairs.theirs = 10;
    }

    // Adds the cost of each partition relative to the paper's choice, on all threads.
    void addPartitions() {
        constexpr const char* kTable = "Section 3, partitions";
        constexpr const char* kWhy =
            "Theirs argues from 16 processors. With few threads and tasks of microseconds partitions differ "
            "by noise.";
        const int n = paperThreads(mAll).back();
        const std::string column = fmt::format("{} thread{}", n, n == 1 ? "" : "s");
        const auto row = [&](const char* name, const char* said, const Spread& ours, const Spread& theirs) {
            add(kTable, name, column, ratioOf(ours, theirs), "of the time of their choice", kWhy).said = said;
        };
        const StereoTimes& there = mTrial.times(n, kAsThere);
        row("left image: dynamic, of static columns", "static columns: even work",
            mTrial.times(n, kLeftDynamic).left, there.left);
        row("warp: rows interleaved, of contiguous", "either; contiguous keeps depths below holes",
            mTrial.times(n, kInterleaved).warp, there.warp);
        row("warp: rows dynamic, of contiguous", "either; contiguous keeps depths below holes",
            mTrial.times(n, kWarpDynamic).warp, there.warp);
        row("holes: contiguous, of dynamic and sorted", "static is not balanced",
            mTrial.times(n, kFillStatic).fill, there.fill);
        row("holes: interleaved, of dynamic and sorted", "static is not balanced",
            mTrial.times(n, kFillInterleaved).fill, there.fill);
    }

    ReportRun& mRun;
    const PaperTimes& mTheirs;
    int mAll;
    StereoTrial mTrial;
    std::string mMeasured;
    StereoCounts mAsThere, mOwn;
    std::deque<PaperRow> mRows;  // deque, since add() returns references to its elements
};

std::unique_ptr<Scene> load(ReportRun& run, const std::string& what, const SceneOptions& options) {
    run.tell("loading " + what);
    Progress quiet([&](double, const std::string&) { run.tell("loading " + what); });
    const SizeOption size = run.quick() ? SizeOption{kFigureWidth / 2, kFigureHeight / 2}
                                        : SizeOption{kFigureWidth, kFigureHeight};
    return loadScene(options, size, quiet);
}

std::string groundText(const Scene& scene) {
    return fmt::format("{}x{} samples", terrainOf(scene)->ground.width(), terrainOf(scene)->ground.height());
}

// Returns the figures of section 6: what McMillan's warp leaves open and shows wrongly.
std::vector<PaperRow> mcMillanRows(ReportRun& run, const Scene& scene, const std::string& measured) {
    StereoWay way{"mcmillan", {}, Schedule::Dynamic, true};
    way.setting.method = RightEyeMethod::McMillan;
    run.tell("stereo, McMillan's warp");
    StereoTrial trial(scene, {way}, run.pick(2, 8));
    const StereoCounts counts = trial.counts(0);
    PaperRow holes;
    holes.paper = kWan;
    holes.table = "Section 6, McMillan's warp";
    holes.row = "left open, of what it painted";
    holes.column = "no rays are cast";
    holes.said = "the splat approach leaves holes";
    holes.ours = exactly(counts.holesOfWarped_percent());
    holes.unit = "%";
    holes.measured = measured;
    holes.why =
        "They describe both errors and give no figures; counted without the sky and without what is open.";
    PaperRow error = holes;
    error.row = "PSNR of what it painted";
    error.said = "exposure errors, invisible occluders";
    error.ours = exactly(counts.psnr_db());
    error.unit = "dB";
    return {holes, error};
}

// Returns the figures of fig. 9: a translucent colon, on 16 processors.
std::vector<PaperRow> colonRows(ReportRun& run, const PaperData& data, double seconds) {
    SceneOptions options;
    options.threads = run.options().threads;
    options.volume.opacity = 0.95;
    const std::filesystem::path file = data.find("colon/gca00020/large_intestine_mask_clean.nrrd");
    options.scene = file.empty() ? "colon" : file.string();
    const std::unique_ptr<Scene> loaded = load(run, "the colon", options);
    const Scene& scene = *loaded;
    std::vector<StereoWay> ways{{"depthsplat", {}, Schedule::Interleaved, true},
                                {"default", {}, Schedule::Dynamic, true}};
    ways[0].setting.method = RightEyeMethod::DepthSplat;
    ways[1].setting.method = defaultMethodFor(rendererOf(scene));
    StereoTrial trial(scene, ways, run.pick(2, 6));
    const int all = threadCount();
    trial.time(run, "stereo, the colon", {all}, run.pick(2, 3), run.pick(2, 8), seconds);
    const glm::ivec3 size = colonOf(scene)->volume.field.frame.size;
    const std::string measured =
        fmt::format("{}, {}x{}x{} voxels, 95 % opacity a millimetre, {}x{}, {} frames of its flight",
                    file.empty() ? std::string("the generated colon") + kStandsIn : "a real colon", size.x,
                    size.y, size.z, scene.lens.width, scene.lens.height, trial.frames());
    std::vector<PaperRow> rows;
    const auto add = [&](const char* name, const std::string& column, Spread ours, double theirs,
                         const char* unit, const char* why, PaperRow::Kind kind) {
        rows.push_back({.paper = kWan,
                        .table = "Section 5",
                        .row = name,
                        .column = column,
                        .theirs = theirs,
                        .ours = ours,
                        .unit = unit,
                        .measured = measured,
                        .why = why,
                        .kind = kind});
    };
    const std::string threads = fmt::format("16 processors there, {} here", all);
    constexpr const char* kWhy =
        "As in Table 2, other processors; the wall is reached in leaps and sampled in vectors.";
    constexpr const char* kWhyW12 =
        "Splatting depths saves the way to the wall alone. Here beams and leaps have made that cheap: nearly "
        "all of a ray is compositing within the wall, which selective warps where it may.";
    const StereoTimes &splat = trial.times(all, 0), &own = trial.times(all, 1);
    using Kind = PaperRow::Kind;
    add("left image (fig. 9, translucent colon)", threads, scaled(splat.left, 1e-3), 0.08, "s", kWhy,
        Kind::Time);
    add("right image (fig. 9, translucent colon)", threads + ", depths splatted", scaled(splat.right, 1e-3),
        0.03, "s", kWhy, Kind::Time);
    add("right image (fig. 9, translucent colon)", threads + ", the default way", scaled(own.right, 1e-3),
        0.03, "s", kWhy, Kind::Time);
    add("saved on the right image (fig. 9, translucent colon)", "depths splatted", savedOf(splat), 62.5, "%",
        kWhyW12, Kind::Other);
    add("saved on the right image (fig. 9, translucent colon)", "the default way", savedOf(own), 62.5, "%",
        kWhyW12, Kind::Other);
    return rows;
}

}  // namespace

void reportPapersStereo(ReportRun& run, double seconds) {
    const PaperData data(run.options().data);
    ReportSection section{"papers-stereo",
                          "Wan et al. 2004: stereo by warping",
                          "Interactive stereoscopic rendering of volumetric environments. Their times are of "
                          "an SGI Power Challenge with up to 16 R10000 of 194 MHz.",
                          {}};
    std::vector<PaperRow> rows;
    const auto append = [&rows](std::vector<PaperRow> more) {
        for (PaperRow& row : more) rows.push_back(std::move(row));
    };
    SceneOptions options;
    options.threads = run.options().threads;
    const std::filesystem::path shaded = data.find("terrain/srtm_bigtujunga30m_utm11.tif"),
                                photo = data.find("terrain/ararat/agri-small-dem-utm38n-30m.tif");
    options.scene = shaded.string();
    std::unique_ptr<Scene> loaded = load(run, "the terrain", options);
    const std::string title = (shaded.empty() ? std::string("the generated terrain") + kStandsIn
                                              : "San Gabriel Mountains, the paper's region") +
                              ", " + groundText(*loaded);
    append(StereoTables(run, kShaded, *loaded, title).rows(0.4 * seconds));
    append(mcMillanRows(run, *loaded, title));
    run.checkTime();
    if (!photo.empty()) {
        options.scene = photo.string();
        options.image = data.find("terrain/ararat/agri-small-winter.jpg").string();
        loaded = load(run, "the terrain with its photo", options);
    }
    const std::string title7 =
        (photo.empty() ? std::string("the generated terrain with its generated colours") + kStandsIn
                       : "Mount Ararat with its photo") +
        ", " + groundText(*loaded);
    append(StereoTables(run, kPhoto, *loaded, title7).rows(0.3 * seconds));
    run.checkTime();
    append(colonRows(run, data, 0.2 * seconds));
    addPaperRows(run.report(), section, std::move(rows));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
