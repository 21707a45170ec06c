// The report's part on ambient occlusion. For several radii it compares every estimate of openness, and the
// older methods that sample 42 directions, with openness traced by many rays.
#include "engine/light/occlusion/occlusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/run.h"
#include "app/report/subjects.h"
#include "engine/base/parallel.h"
#include "engine/light/occlusion/occlusion_rays.h"

namespace stereonav {
namespace {

constexpr int kTruthDirections = 256;

struct Texels {
    std::vector<glm::ivec3> at;
    std::vector<double> truth;  // obscurance
};

// A request for the traced openness at some of the block's texels.
struct OpennessOrder {
    double radius;
    std::size_t texels, first, end;
};

Texels tracedTexels(ReportRun& run, const GreyVolume& volume, double radius) {
    constexpr std::size_t kTexels = 100;  // texels in each piece of work
    Texels texels;
    texels.at = surfaceVoxels(volume, kBlockSurface, static_cast<std::size_t>(run.pick(400, 1500)));
    const std::size_t count = texels.at.size();
    std::vector<UntimedPiece> pieces;
    for (std::size_t n = 0; n < count; n += kTexels)
        pieces.push_back(
            pieceOf(Untimed::Openness, OpennessOrder{radius, count, n, std::min(count, n + kTexels)}));
    for (const PeerBytes& piece : run.untimed().all(pieces)) {
        const std::vector<double> some = ByteReader(piece).getArray<double>();
        texels.truth.insert(texels.truth.end(), some.begin(), some.end());
    }
    return texels;
}

void setErrors(WayPoint& point, const std::vector<double>& values, const Texels& texels) {
    double sum = 0, worst = 0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        const double off = std::abs(values[n] - texels.truth[n]);
        sum += off * off;
        worst = std::max(worst, off);
    }
    point.way.error = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
    point.worstError = worst;
}

WayPoint estimated(ReportRun& run, const GreyVolume& volume, OcclusionMethod method, const char* name,
                   int radius, const Texels& texels) {
    std::vector<double> ms;
    OpennessVolume openness;
    for (int n = 0; n < run.pick(5, 15); ++n) {
        run.tell("ambient occlusion");
        Progress quiet;
        const Stopwatch watch;
        openness = estimateOpenness(volume, method, glm::ivec3(radius), quiet);
        ms.push_back(watch.elapsed_ms());
    }
    std::vector<double> values;
    for (const glm::ivec3& at : texels.at)
        values.push_back(std::min(kFlatWallGain * openness.at(at) / 255.0, 1.0));
    WayPoint point{{name, spreadOf(ms), 0, method == OcclusionMethod::Gaussian},
                   "from moments and extrema of a box, all voxels"};
    setErrors(point, values, texels);
    return point;
}

// Measures a directed method at the texels and scales its time to all voxels, since the estimates are timed
// over all voxels.
WayPoint directed(ReportRun& run, const GreyVolume& volume, DirectionMethod method, const char* name,
                  double radius, const Texels& texels) {
    std::vector<double> ms, values(texels.at.size());
    const double scale = static_cast<double>(volume.frame.count()) /
                         static_cast<double>(std::max<std::size_t>(texels.at.size(), 1));
    for (int n = 0; n < run.pick(3, 9); ++n) {
        run.tell("ambient occlusion");
        const Stopwatch watch;
        parallelFor(static_cast<int>(texels.at.size()), [&](int k) {
            values[static_cast<std::size_t>(k)] =
                opennessByDirections(volume, texels.at[static_cast<std::size_t>(k)], method, radius);
        });
        ms.push_back(watch.elapsed_ms() * scale);
    }
    WayPoint point{{name, spreadOf(ms)},
                   "42 directions a voxel; the time of the texels, scaled to all voxels"};
    setErrors(point, values, texels);
    return point;
}

WayChart chartOf(ReportRun& run, const GreyVolume& volume, int radius) {
    const double metres = radius * volume.frame.spacing.x;
    const Texels texels = tracedTexels(run, volume, metres);
    WayChart chart;
    chart.id = fmt::format("occlusion/radius {}", radius);
    chart.title = fmt::format("Ambient occlusion, radius {} voxels", radius);
    chart.setting = fmt::format("{} texels, {} threads", texels.at.size(), threadCount());
    chart.text = fmt::format(
        "A made block with three holes, {}x{}x{} voxels. Error of the openness as it is shown, min(2 O, 1), "
        "against obscurance traced in {} directions, at texels of the surface.",
        volume.frame.size.x, volume.frame.size.y, volume.frame.size.z, kTruthDirections);
    chart.why =
        "The default takes moments alone: the ends of the reconstruction are the box's extrema, which one "
        "voxel of noise or metal moves. Drawn in to three standard deviations they move less, at about twice "
        "the time.";
    chart.timeLabel = "ms for the volume";
    chart.errorLabel = "RMS error of openness";
    chart.errorUnit = "of 1";
    chart.points = {estimated(run, volume, OcclusionMethod::Gaussian, "gaussian", radius, texels),
                    estimated(run, volume, OcclusionMethod::Reconstructed, "reconstructed", radius, texels),
                    estimated(run, volume, OcclusionMethod::DrawnIn, "drawn in", radius, texels),
                    estimated(run, volume, OcclusionMethod::Chebyshev, "chebyshev", radius, texels),
                    directed(run, volume, DirectionMethod::Vicinity, "vicinity", metres, texels),
                    directed(run, volume, DirectionMethod::Obscurance, "obscurance 42", metres, texels)};
    return chart;
}

struct KeptTexels {
    GreyVolume volume;
    std::vector<glm::ivec3> at;
};

}  // namespace

PeerBytes makeOpenness(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<OpennessOrder>();
    run.tell("ambient occlusion, the truth");
    const auto kept = run.untimed().kept<KeptTexels>(fmt::format("openness {}", asked.texels), [&] {
        KeptTexels texels{blockWithHoles(), {}};
        texels.at = surfaceVoxels(texels.volume, kBlockSurface, asked.texels);
        return texels;
    });
    std::vector<double> truth(asked.end - asked.first);
    parallelFor(static_cast<int>(truth.size()), [&](int n) {
        const auto k = static_cast<std::size_t>(n);
        truth[k] =
            traceOpenness(kept->volume, kept->at[asked.first + k], asked.radius, kTruthDirections).obscurance;
    });
    return ByteWriter().putArray(std::span<const double>(truth)).take();
}

void reportOcclusion(ReportRun& run, double) {
    ReportSection section{"occlusion", "Ambient occlusion", "", {}};
    const GreyVolume volume = blockWithHoles();
    for (const int radius : run.brief() ? std::vector<int>{5} : std::vector<int>{3, 5, 10, 20})
        addChart(run.report(), section, chartOf(run, volume, radius));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
