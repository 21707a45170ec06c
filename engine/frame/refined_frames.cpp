#include "engine/frame/refined_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/frame/sliced_frames.h"
#include "engine/sampling/pixel_samples.h"
#include "engine/stereo/error_prediction.h"

namespace stereonav {
namespace {

constexpr float kScale = 1.0f / 1023.0f;

// Adds a frame to the sums of its half, or begins them. A row of sums has three runs, one for each channel:
// loops that the compiler turns into vectors.
void addColors(const Plane<PackedColor>& color, bool begin, Plane<float>& sums) {
    const int width = color.width();
    sums.resize(3 * width, color.height());
    parallelFor(color.height(), [&](int y) {
        const PackedColor* const from = color.row(y);
        for (int c = 0; c < 3; ++c) {
            float* const __restrict to = sums.row(y) + static_cast<std::size_t>(c) * width;
            const float keep = begin ? 0.0f : 1.0f;
            for (int x = 0; x < width; ++x) {
                const float root = static_cast<float>(static_cast<int>(from[x] >> 10 * c & 1023u)) * kScale;
                to[x] = keep * to[x] + root * root;
            }
        }
    });
}

// The mean of both halves as packColor has it.
void packMean(const Plane<float>& even, const Plane<float>& odd, int count, Plane<PackedColor>& color) {
    const float perAll = 1.0f / static_cast<float>(count);
    const int width = color.width();
    parallelFor(color.height(), [&](int y) {
        PackedColor* const __restrict to = color.row(y);
        for (int c = 0; c < 3; ++c) {
            const std::size_t first = static_cast<std::size_t>(c) * width;
            const float *const a = even.row(y) + first, *const b = odd.row(y) + first;
            for (int x = 0; x < width; ++x) {
                const float root = std::sqrt((a[x] + b[x]) * perAll) * 1023.0f + 0.5f;
                const auto channel =
                    static_cast<std::uint32_t>(static_cast<int>(root < 1023.0f ? root : 1023.0f));
                to[x] = (c == 0 ? 0u : to[x]) | channel << 10 * c;
            }
        }
    });
}

// Returns the sum of squared differences between the means of the halves. Each row is summed by itself, so
// that the result does not depend on the number of threads.
double squaresApart(const Plane<float>& even, const Plane<float>& odd, int count) {
    const int odds = count / 2, evens = count - odds;
    const float perEven = 1.0f / static_cast<float>(evens), perOdd = 1.0f / static_cast<float>(odds);
    std::vector<double> squares(static_cast<std::size_t>(even.height()));
    parallelFor(even.height(), [&](int y) {
        const float *const a = even.row(y), *const b = odd.row(y);
        double sum = 0;
        for (int x = 0; x < even.width(); ++x) {
            const float apart = std::sqrt(a[x] * perEven) - std::sqrt(b[x] * perOdd);
            sum += static_cast<double>(apart * apart);
        }
        squares[static_cast<std::size_t>(y)] = sum;
    });
    return std::accumulate(squares.begin(), squares.end(), 0.0);
}

double channelsOf(const EyeImage& eye) {
    return 3.0 * eye.width() * eye.height();
}

}  // namespace

namespace {

// For one frame.
class Turned {
public:
    Turned(FrameMaker& frames, int count) : mFrames(dynamic_cast<SlicedFrames*>(&frames)) {
        constexpr double kGolden = 0.6180339887498949;  // its multiples cover 0 to 1 evenly
        double whole = 0;
        if (mFrames) mFrames->setTurn(std::modf(count * kGolden, &whole));
    }
    ~Turned() {
        if (mFrames) mFrames->setTurn(0);
    }
    Turned(const Turned&) = delete;
    Turned& operator=(const Turned&) = delete;

private:
    SlicedFrames* mFrames;
};

}  // namespace

void RefinedFrames::add(FrameMaker& frames, const StereoViews& views, double time, const FrameWay& way) {
    const Turned turned(frames, mCount);
    frames.make(shiftedBy(views, evenPlace(mCount)), time, way, next());
    gather();
}

void RefinedFrames::addOne(FrameMaker& frames, const EyeView& view, double time) {
    const Turned turned(frames, mCount);
    frames.makeOne(shiftedBy(view, evenPlace(mCount)), time, next());
    gather();
}

void RefinedFrames::begin(const EyePair& made) {
    mCount = 0;
    mMean = made;
    gather();
}

void RefinedFrames::gather() {
    const EyePair& made = next();
    const int index = mCount++;
    Plane<float> Sums::*const half = index % 2 == 0 ? &Sums::even : &Sums::odd;
    addColors(made.left.color, index < 2, mLeft.*half);
    addColors(made.right.color, index < 2, mRight.*half);
    mMean.timings = made.timings;
}

EyePair& RefinedFrames::mean() {
    if (mCount > 1) {
        packMean(mLeft.even, mLeft.odd, mCount, mMean.left.color);
        packMean(mRight.even, mRight.odd, mCount, mMean.right.color);
    }
    return mMean;
}

double RefinedFrames::error_levels() const {
    if (mCount < 2) return std::numeric_limits<double>::infinity();
    const double squares =
        squaresApart(mLeft.even, mLeft.odd, mCount) + squaresApart(mRight.even, mRight.odd, mCount);
    return 0.5 * 255 * std::sqrt(squares / (channelsOf(mMean.left) + channelsOf(mMean.right)));
}

double RefinedFrames::error_db() const {
    const double levels = error_levels();
    if (!std::isfinite(levels)) return 0;
    return levels > 0 ? std::clamp(20 * std::log10(255 / levels), 0.0, kMostPsnr_db) : kMostPsnr_db;
}

}  // namespace stereonav
