// Elevation samples between the source's own: cubic, kept within the samples around; then summits and pits,
// which any interpolation between two grids lowers, are put back.
#include "terrain/read/gdal/dem_resample.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "terrain/read/gdal/sample_reader.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr int kResampleBand = 64;  // rows between two reports of progress

// Puts the source's summits and pits into the target's heights.
class ExtremeKeeper {
public:
    ExtremeKeeper(const SampleReader& reader, const Georeference& source, const Georeference& target,
                  const PixelMap& toSource, const PixelMap& toTarget, std::vector<float>& heights)
        : mReader(reader),
          mSource(source),
          mTarget(target),
          mToSource(toSource),
          mToTarget(toTarget),
          mHeights(heights),
          mTaken(heights.size(), false) {}

    // sign: 1 summits, -1 pits.
    void keepRow(int row, float sign) {
        for (int i = 0; i < mSource.width; ++i)
            if (isExtreme(i, row, sign)) keep(i, row);
    }

private:
    struct Place {
        int i = 0, j = 0;
        double distance = std::numeric_limits<double>::infinity();  // squared, source samples
    };

    bool isExtreme(int i, int j, float sign) const {
        const float height = sign * mReader.at(i, j);
        if (std::isnan(height)) return false;
        bool aboveOne = false;  // a plain is neither
        for (int b = std::max(j - 1, 0); b <= std::min(j + 1, mSource.height - 1); ++b)
            for (int a = std::max(i - 1, 0); a <= std::min(i + 1, mSource.width - 1); ++a) {
                const float other = sign * mReader.at(a, b);
                if (other > height) return false;
                aboveOne |= other < height;
            }
        return aboveOne;
    }

    glm::dvec2 offset(const Place& p, int i, int j) const {
        return mToSource.at(p.i, p.j) - glm::dvec2(i + 0.5, j + 0.5);
    }

    Place placeAt(int a, int b, int i, int j) const {
        Place p{a, b};
        if (a < 0 || b < 0 || a >= mTarget.width || b >= mTarget.height) return p;
        const glm::dvec2 d = offset(p, i, j);
        const double squared = d.x * d.x + d.y * d.y;
        if (std::isfinite(squared)) p.distance = squared;
        return p;
    }

    // The target's sample nearest to a sample of the source: downhill from where the map back leads, which of
    // control points is another fit.
    Place nearest(int i, int j) const {
        const glm::dvec2 guess = mToTarget.at(i, j);
        if (!std::isfinite(guess.x + guess.y)) return {};
        const auto side = [](double x, int count) {
            return static_cast<int>(std::clamp(x, 0.0, count - 1.0));
        };
        Place best = placeAt(side(guess.x, mTarget.width), side(guess.y, mTarget.height), i, j);
        constexpr int kMostSteps = 64;
        for (int step = 0; step < kMostSteps; ++step) {
            const Place from = best;
            for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a) {
                    const Place next = placeAt(from.i + a, from.j + b, i, j);
                    if (next.distance < best.distance) best = next;
                }
            if (best.i == from.i && best.j == from.j) break;
        }
        return best;
    }

    void keep(int i, int j) {
        const Place centre = nearest(i, j);
        const float height = mReader.at(i, j);
        Place best;
        for (int b = centre.j - 1; b <= centre.j + 1; ++b)
            for (int a = centre.i - 1; a <= centre.i + 1; ++a) {
                const Place p = placeAt(a, b, i, j);
                if (!std::isfinite(p.distance)) continue;
                const glm::dvec2 d = offset(p, i, j);
                // Beyond a sample the height would not lie within those around any more.
                if (std::max(std::abs(d.x), std::abs(d.y)) > 1) continue;
                const std::size_t at = index(p);
                if (mHeights[at] == height && p.distance <= 0.5) return;  // it is there
                if (!mTaken[at] && !std::isnan(mHeights[at]) && p.distance < best.distance) best = p;
            }
        if (!std::isfinite(best.distance)) return;
        mHeights[index(best)] = height;
        mTaken[index(best)] = true;
    }

    std::size_t index(const Place& p) const { return static_cast<std::size_t>(p.j) * mTarget.width + p.i; }

    const SampleReader& mReader;
    const Georeference &mSource, &mTarget;
    const PixelMap &mToSource, &mToTarget;
    std::vector<float>& mHeights;
    std::vector<bool> mTaken;  // holds a summit or pit already
};

}  // namespace

ResampledDem resampleDem(const std::vector<float>& samples, const Georeference& source,
                         const Georeference& target, const std::filesystem::path& file, Progress& progress) {
    const std::string doing = "bringing " + file.filename().string() + " to metres";
    const PixelMap toSource = mapPixels(target, source, file), toTarget = mapPixels(source, target, file);
    const SampleReader reader(samples.data(), {0, 0, source.width, source.height}, source.width,
                              source.height);
    ResampledDem result;
    result.heights.resize(static_cast<std::size_t>(target.width) * target.height);
    std::atomic<long long> outside{0};
    for (int first = 0; first < target.height; first += kResampleBand) {
        progress.report(0.6 * first / target.height, doing);
        parallelFor(std::min(kResampleBand, target.height - first), [&](int k) {
            float* out = &result.heights[static_cast<std::size_t>(first + k) * target.width];
            long long missed = 0;
            for (int i = 0; i < target.width; ++i) {
                const glm::dvec2 pixel = toSource.at(i, first + k);
                const bool inside = reader.inside(pixel);
                out[i] = inside ? reader.between(pixel) : std::numeric_limits<float>::quiet_NaN();
                missed += !inside;
            }
            outside += missed;
        });
    }
    result.outside = outside;
    ExtremeKeeper keeper(reader, source, target, toSource, toTarget, result.heights);
    for (const float sign : {1.0f, -1.0f})
        for (int row = 0; row < source.height; ++row) {
            if (row % kResampleBand == 0)
                progress.report((sign > 0 ? 0.6 : 0.8) + 0.2 * row / source.height, doing);
            keeper.keepRow(row, sign);
        }
    progress.report(1, doing);
    return result;
}

}  // namespace stereonav
