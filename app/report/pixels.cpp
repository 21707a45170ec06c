// The report's part on pictures under baked light: against path tracing from every pixel, by samples,
// resolution and kind of bake, and by lookup of texels (Wyman et al. 2006, fig. 6; Y5, Y11 of
// docs/ledger.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "app/report/light.h"
#include "engine/base/parallel.h"
#include "engine/light/bake/bake_job.h"
#include "engine/light/paths/pixel_path.h"
#include "engine/light/transfer/seen_bricks.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

using Lookup = IlluminationVolume::Lookup;
using Light = std::shared_ptr<const IlluminationVolume>;

// Returns a view down at the middle hole: its wall, its rim and the plane around it fill the picture.
EyeView closeView(const VolumeFrame& frame, int width, int height) {
    constexpr double kHalfWidth = 0.22;  // half width of the view at depth 1
    const glm::dvec3 middle = frame.worldFromVoxel(0.5 * glm::dvec3(frame.size - 1));
    EyeView view;
    view.eye = view.head = middle + glm::dvec3(0.018, -0.03, 0.08);
    view.forward = glm::normalize(middle + glm::dvec3(0, 0, 0.018) - view.eye);
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0, 1, 0)));
    view.up = glm::cross(view.right, view.forward);
    view.xMax = kHalfWidth;
    view.yMax = kHalfWidth * height / width;
    view.xMin = -view.xMax;
    view.yMin = -view.yMax;
    view.width = width;
    view.height = height;
    view.nearDepth = 1e-3;
    return view;
}

VolumeScene blockScene() {
    VolumeScene scene;
    scene.field = blockWithHoles();
    Progress quiet;
    const auto surface = static_cast<float>(kBlockSurface);
    scene.cells = findSurfaceCells(scene.field, {surface, surface, surface, nullptr}, quiet);
    scene.look.specular = 0;
    return scene;
}

// Returns milliseconds.
double castBlock(const VolumeScene& scene, const EyeView& view, EyeImage& image) {
    const VolumeRenderer renderer(scene);
    image.resize(view.width, view.height, renderer.viewDependence());
    const Stopwatch watch;
    renderEye(renderer, view, image);
    return watch.elapsed_ms();
}

// Returns the luminance at the pixels that show a surface, row by row.
template <typename LightAt>
std::vector<double> overPixels(const Plane<float>& depths, const LightAt& lightAt) {
    std::vector<double> light;
    for (int y = 0; y < depths.height(); ++y)
        for (int x = 0; x < depths.width(); ++x)
            if (depths.at(x, y) < kMissDepth) light.push_back(luminance(glm::dvec3(lightAt(x, y))));
    return light;
}

// Traces paths of a stream from the visible points and returns their luminance; ms: time of tracing.
std::vector<double> pathLight(const VolumeScene& scene, const LightSetup& setup, std::uint64_t seed,
                              const EyeView& view, const Plane<float>& depths, std::uint32_t stream,
                              int samples, Progress& progress, double& ms) {
    TexelSampling sampling;
    sampling.seed = 1000 * seed + kFirstSeed;
    const PixelPaths paths(scene, setup, sampling);
    Plane<TexelSum> sums;
    const Stopwatch watch;
    paths.add(view, depths, stream, samples, sums, progress);
    ms = watch.elapsed_ms();
    return overPixels(depths, [&](int x, int y) { return sums.at(x, y).mean; });
}

// Rows of a picture of the block.
struct PixelTruthOrder {
    std::uint64_t seed;
    std::uint32_t stream;
    int width, height, samples, firstRow, rows;
};
struct SeenBlock {
    VolumeScene scene = blockScene();
    LightSetup setup = clearSkyLight();
    EyeView view;
    EyeImage image;
};

class PixelSubject {
public:
    explicit PixelSubject(ReportRun& run) : mRun(run), mSetup(clearSkyLight()), mScene(blockScene()) {
        mView = closeView(mScene.field.frame, run.pick(64, 96), run.pick(48, 72));
        cast(mImage);
        mTruthSamples = run.pick(512, 2048);
        // The halves have independent noise: their difference is twice the error of their mean.
        const std::vector<std::vector<double>> halves = truths();
        const std::vector<double>&a = halves[0], &b = halves[1];
        for (std::size_t n = 0; n < a.size(); ++n) mTruth.push_back(0.5 * (a[n] + b[n]));
        mTruthError = 0.5 * relativeRms(a, b);
    }

    struct Bake {
        Light light;
        double ms = 0;
        std::vector<double> relight_ms;  // times of relighting the visible part, for transfer
        std::size_t texels = 0;
    };
    // Bakes the texels that the picture looks up.
    Bake irradiance(int samples, double perVoxel) const {
        const Made made = make({BakeKind::Irradiance, 0, 1}, samples, perVoxel);
        return {
            std::make_shared<IlluminationVolume>(illuminationOf(made.sums)), made.ms, {}, made.sums.texels()};
    }
    Bake transfer(int samples) const {
        const Made made = make({BakeKind::Transfer, kDefaultOrder, 1}, samples, 1);
        const TransferVolume transfer = transferOf(made.sums);
        const std::vector<glm::vec3> sky = mSetup.probe->project(kDefaultOrder);
        auto light = std::make_shared<IlluminationVolume>(transfer.frame());
        Bake bake{light, made.ms, {}, made.sums.texels()};
        for (int n = 0; n < repeats(); ++n) {
            const Stopwatch watch;
            transfer.relight(sky, transfer.heldAmong(bricksSeen(mView, mImage, *light)), *light);
            bake.relight_ms.push_back(watch.elapsed_ms());
        }
        return bake;
    }

    // Measures a frame that looks the bake up.
    WayPoint lookedUp(const Bake& bake, Lookup lookup) {
        mRun.tell("light, pictures");
        mScene.look.baked.light = bake.light;
        mScene.look.baked.lookup = lookup;
        std::vector<double> ms(static_cast<std::size_t>(repeats()));
        EyeImage image;
        for (double& time_ms : ms) time_ms = cast(image);
        for (std::size_t n = 0; n < bake.relight_ms.size(); ++n) ms[n] += bake.relight_ms[n];
        mScene.look.baked = {};
        return pointOf(ms, lightLookedUp(*bake.light, lookup), bake.ms / 1000, bake.texels);
    }
    // Measures a frame whose pixels are path traced.
    WayPoint tracedPoint(int samples) {
        std::vector<double> ms, light;
        for (int n = 0; n < mRun.pick(1, 3); ++n) {
            double took = 0;
            light = traced(kFirstStream + static_cast<std::uint32_t>(n), samples, took);
            EyeImage image;
            ms.push_back(took + cast(image));
        }
        return pointOf(ms, light, 0, 0);
    }

    std::string setting() const {
        return fmt::format(
            "{}x{} pixels, {} of them on the surface, {} threads, seed {}, truth of {} paths a pixel",
            mView.width, mView.height, mTruth.size(), threadCount(), mRun.options().seed, 2 * mTruthSamples);
    }
    std::string text() const {
        return fmt::format(
            "A look into the middle hole of the made block under a clear sky, {} bounces. Truth: paths "
            "traced from every pixel, {} each, whose own error is {} %. Bakes are of the texels that this "
            "picture looks up; seconds of them are in the table.",
            kReportBounces, 2 * mTruthSamples, numberText(100 * mTruthError));
    }

private:
    static constexpr std::uint32_t kTruthStream = 1000, kFirstStream = 1;
    struct Made {
        BakeSums sums;
        double ms;
    };

    int repeats() const { return mRun.pick(15, 40); }

    double cast(EyeImage& image) const { return castBlock(mScene, mView, image); }

    // Returns both halves of the truth, row by row.
    std::vector<std::vector<double>> truths() const {
        constexpr int kRows = 6;  // rows of a piece
        std::vector<UntimedPiece> pieces;
        for (const std::uint32_t stream : {kTruthStream, kTruthStream + 1})
            for (int y = 0; y < mView.height; y += kRows)
                pieces.push_back(
                    pieceOf(Untimed::PixelTruth,
                            PixelTruthOrder{mRun.options().seed, stream, mView.width, mView.height,
                                            mTruthSamples, y, std::min(kRows, mView.height - y)}));
        const std::vector<PeerBytes> made = mRun.untimed().all(pieces);
        std::vector<std::vector<double>> halves(2);
        for (std::size_t n = 0; n < made.size(); ++n) {
            const std::vector<double> rows = ByteReader(made[n]).getArray<double>();
            std::vector<double>& half = halves[2 * n / made.size()];
            half.insert(half.end(), rows.begin(), rows.end());
        }
        return halves;
    }
    // Traces all pixels; ms: time taken.
    std::vector<double> traced(std::uint32_t stream, int samples, double& ms) const {
        Progress telling([this](double, const std::string&) { mRun.tell("light, paths from every pixel"); });
        return pathLight(mScene, mSetup, mRun.options().seed, mView, mImage.viewDepth, stream, samples,
                         telling, ms);
    }
    std::vector<double> lightLookedUp(const IlluminationVolume& light, Lookup lookup) const {
        return overPixels(mImage.viewDepth, [&](int x, int y) {
            const glm::dvec3 world =
                mView.pointAt(x + 0.5, y + 0.5, static_cast<double>(mImage.viewDepth.at(x, y)));
            return lookup == Lookup::NearestIsovalue
                       ? light.nearestIsovalue(world, mScene.field, mScene.cells.isovalue).value
                       : light.at(world, lookup).value;
        });
    }

    Made make(const BakeShape& shape, int samples, double perVoxel) const {
        mRun.tell("light, bakes of a picture");
        const VolumeFrame texels = texelFrame(mScene.field.frame, perVoxel);
        const IlluminationVolume empty(texels);
        const auto surface = static_cast<float>(kBlockSurface);
        const TexelChooser chooser(mScene.field, texels, {surface, surface, nullptr, false});
        std::vector<TexelBrick> bricks;
        for (const std::uint32_t number : bricksSeen(mView, mImage, empty, 1))
            bricks.push_back({number, chooser.brick(number)});
        std::erase_if(bricks, [](const TexelBrick& brick) { return countTexels(brick.wanted) == 0; });
        std::sort(bricks.begin(), bricks.end(),
                  [](const TexelBrick& a, const TexelBrick& b) { return a.number < b.number; });
        Made made{BakeSums(texels, std::move(bricks), shape), 0};
        TexelSampling sampling;
        sampling.seed = 1000 * mRun.options().seed + kFirstSeed + 1;
        const TexelLighter lighter(mScene.field, texels, mSetup, sampling);
        Progress quiet;
        const Stopwatch watch;
        runBake(made.sums, sourceOf(lighter), {samples, 0, 0}, quiet);
        made.ms = watch.elapsed_ms();
        return made;
    }

    WayPoint pointOf(const std::vector<double>& ms, const std::vector<double>& light, double bake_s,
                     std::size_t texels) const {
        return {{"", spreadOf(ms), 100 * relativeRms(light, mTruth)},
                "",
                100 * relativeWorst(light, mTruth),
                {{"bake, s", bake_s}, {"texels", static_cast<double>(texels)}}};
    }

    ReportRun& mRun;
    LightSetup mSetup;
    VolumeScene mScene;
    EyeView mView;
    EyeImage mImage;  // provides depths
    std::vector<double> mTruth;
    int mTruthSamples = 0;
    double mTruthError = 0;
};

WayChart pictureChart(const PixelSubject& subject, const char* id, const char* title) {
    WayChart chart;
    chart.id = id;
    chart.title = title;
    chart.text = subject.text();
    chart.setting = subject.setting();
    chart.timeLabel = "ms a frame";
    chart.errorLabel = "RMS error, % of the light";
    chart.errorUnit = "%";
    return chart;
}

void add(WayChart& chart, WayPoint point, const std::string& name, const std::string& detail,
         bool isDefault = false) {
    point.way.name = name;
    point.way.isDefault = isDefault;
    point.detail = detail;
    chart.points.push_back(std::move(point));
}

}  // namespace

PeerBytes makePixelTruth(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<PixelTruthOrder>();
    const std::string words = "light, paths from every pixel";
    run.tell(words);
    const auto seen =
        run.untimed().kept<SeenBlock>(fmt::format("pixels {}x{}", asked.width, asked.height), [&] {
            SeenBlock block;
            block.view = closeView(block.scene.field.frame, asked.width, asked.height);
            castBlock(block.scene, block.view, block.image);
            return block;
        });
    Plane<float> depths = seen->image.viewDepth;  // other rows have no depth
    for (int y = 0; y < depths.height(); ++y)
        if (y < asked.firstRow || y >= asked.firstRow + asked.rows)
            std::fill_n(depths.row(y), depths.width(), kMissDepth);
    Progress telling([&](double, const std::string&) { run.tell(words); });
    double ms = 0;
    const std::vector<double> light = pathLight(seen->scene, seen->setup, asked.seed, seen->view, depths,
                                                asked.stream, asked.samples, telling, ms);
    return ByteWriter().putArray(std::span<const double>(light)).take();
}

void addPixelCharts(ReportRun& run, ReportSection& section) {
    run.tell("light, paths from every pixel");
    PixelSubject subject(run);
    WayChart paths = pictureChart(subject, "light/pixels", "Path tracing");
    paths.text +=
        " Traced: nothing is baked, every pixel has so many paths. Baked: light is looked up; transfer is "
        "dotted with the sky in every frame, for what is seen.";
    paths.why = "More samples and texels cost nothing in a frame, but time and memory in the bake.";
    for (const int samples : {1, 4, 16, 64, 256})
        if (samples <= run.pick(64, 256))
            add(paths, subject.tracedPoint(samples), fmt::format("traced {}", samples),
                fmt::format("{} paths from every pixel", samples));
    PixelSubject::Bake usual;
    for (const int samples : {16, 64, kDefaultSamples}) {
        const PixelSubject::Bake bake = subject.irradiance(samples, 1);
        add(paths, subject.lookedUp(bake, Lookup::Trilinear), fmt::format("baked {}", samples),
            fmt::format("irradiance, {} samples a texel, a texel a voxel", samples),
            samples == kDefaultSamples);
        usual = bake;
    }
    const PixelSubject::Bake coarse = subject.irradiance(kDefaultSamples, 0.5),
                             fine = subject.irradiance(run.pick(64, kDefaultSamples), 2);
    const std::string fineText =
        fmt::format("irradiance, {} samples a texel, 8 texels a voxel", run.pick(64, kDefaultSamples));
    add(paths, subject.lookedUp(coarse, Lookup::Trilinear), "baked 1/8",
        fmt::format("irradiance, {} samples a texel, 1/8 texel a voxel", kDefaultSamples));
    add(paths, subject.lookedUp(fine, Lookup::Trilinear), "baked 8", fineText);
    add(paths, subject.lookedUp(subject.transfer(kDefaultSamples), Lookup::Trilinear),
        fmt::format("transfer {}", kDefaultSamples),
        fmt::format("order {}, {} samples a texel, a texel a voxel", kDefaultOrder, kDefaultSamples));
    addChart(run.report(), section, std::move(paths));

    WayChart lookups = pictureChart(subject, "light/lookup", "Lookup of baked light");
    lookups.text += fmt::format(
        " Irradiance with {} samples a texel. The trilinear lookup is vector code in the casters, the others "
        "are there to be compared, in plain code: their times say little.",
        kDefaultSamples);
    lookups.why = "What comes nearer to the truth costs more texels, or a lookup of 64 of them.";
    const std::pair<const char*, Lookup> ways[] = {{"nearest", Lookup::Nearest},
                                                   {"nearest isovalue", Lookup::NearestIsovalue},
                                                   {"trilinear", Lookup::Trilinear},
                                                   {"tricubic", Lookup::Tricubic}};
    for (const auto& [name, lookup] : ways)
        add(lookups, subject.lookedUp(usual, lookup), name, "a texel a voxel", lookup == Lookup::Trilinear);
    for (const auto& [name, lookup] : ways) {
        if (lookup != Lookup::Trilinear && run.brief()) continue;
        add(lookups, subject.lookedUp(coarse, lookup), fmt::format("{}, 1/8", name), "1/8 texel a voxel");
        add(lookups, subject.lookedUp(fine, lookup), fmt::format("{}, 8", name),
            "8 texels a voxel, " + fineText);
    }
    addChart(run.report(), section, std::move(lookups));
}

}  // namespace stereonav
