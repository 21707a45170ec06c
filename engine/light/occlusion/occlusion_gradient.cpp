// Opacity modulation by the gradient of the openness (Ruiz et al. 2010, section 4.2). The regression's
// weights depend on the distance alone, so whole rows of neighbours are added first, as whole numbers, and
// weighed once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/occlusion/occlusion.h"

namespace stereonav {
namespace {

constexpr float kEdge = 0.70710678118654752f, kCorner = 0.57735026918962576f;  // 1 / distance
constexpr float kSum = 2 + 8 * kEdge + 8 * kCorner;

using Row = std::vector<std::int32_t>;  // a row with one more column at either end

// The nine rows around one, and sums and differences of them.
class GradientRowSums {
public:
    explicit GradientRowSums(int width) : mWidth(width) {
        for (Row* row : {&mMiddle, &mSides, &mCorners}) row->resize(static_cast<std::size_t>(width) + 2);
        for (auto& pair : mSteps)
            for (Row& row : pair) row.resize(static_cast<std::size_t>(width) + 2);
        for (Row& row : mRows) row.resize(static_cast<std::size_t>(width) + 2);
    }

    void gather(const OpennessVolume& openness, int j, int k) {
        const glm::ivec3 size = openness.frame.size;
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y) {
                const int row = std::clamp(j + y, 0, size.y - 1), slice = std::clamp(k + z, 0, size.z - 1);
                copyRow(openness.values.data() + openness.frame.index(0, row, slice), at(y, z));
            }
        for (std::size_t i = 0; i < mMiddle.size(); ++i) addColumn(i);
    }

    // Squared length of the gradient at column i, times kSum^2.
    float squaredLength(int column) const {
        const auto i = static_cast<std::size_t>(column) + 1;
        const auto along = [&](const Row& r) { return static_cast<float>(r[i + 1] - r[i - 1]); };
        const auto both = [&](const Row& r) { return static_cast<float>(r[i + 1] + r[i - 1]); };
        const auto own = [&](const Row& r) { return static_cast<float>(r[i]); };
        const float x = along(mMiddle) + kEdge * along(mSides) + kCorner * along(mCorners);
        float sum = x * x;
        for (const auto& [straight, slanted] : mSteps) {
            const float g = own(straight) + kEdge * (both(straight) + own(slanted)) + kCorner * both(slanted);
            sum += g * g;
        }
        return sum;
    }

private:
    Row& at(int y, int z) { return mRows[static_cast<std::size_t>(z + 1) * 3 + (y + 1)]; }
    void copyRow(const std::uint8_t* from, Row& to) const {
        std::copy_n(from, mWidth, to.begin() + 1);
        to.front() = from[0];
        to.back() = from[mWidth - 1];
    }
    void addColumn(std::size_t i) {
        const auto v = [&](int y, int z) { return at(y, z)[i]; };
        mMiddle[i] = v(0, 0);
        mSides[i] = v(-1, 0) + v(1, 0) + v(0, -1) + v(0, 1);
        mCorners[i] = v(-1, -1) + v(1, -1) + v(-1, 1) + v(1, 1);
        mSteps[0][0][i] = v(1, 0) - v(-1, 0);
        mSteps[0][1][i] = v(1, -1) - v(-1, -1) + v(1, 1) - v(-1, 1);
        mSteps[1][0][i] = v(0, 1) - v(0, -1);
        mSteps[1][1][i] = v(-1, 1) - v(-1, -1) + v(1, 1) - v(1, -1);
    }

    int mWidth;
    std::array<Row, 9> mRows;
    Row mMiddle, mSides, mCorners;
    std::array<std::array<Row, 2>, 2> mSteps;  // along j and along k: in the row's own plane, and beside it
};

}  // namespace

Volume<std::uint8_t> gradientModulation(const OpennessVolume& openness, double gradientMax) {
    if (!(gradientMax > 0 && std::isfinite(gradientMax)))
        throw Error("", "gradient of the opacity modulation",
                    fmt::format("expected a number above 0, got {}", gradientMax), "choose a larger one");
    Volume<std::uint8_t> modulation(openness.frame);
    if (openness.empty()) return modulation;
    const glm::ivec3 size = openness.frame.size;
    const auto perLength = static_cast<float>(std::min(1.0 / (kSum * gradientMax), 1e6));
    parallelFor(size.z, [&](int k) {
        GradientRowSums sums(size.x);
        for (int j = 0; j < size.y; ++j) {
            sums.gather(openness, j, k);
            std::uint8_t* to = modulation.values.data() + modulation.frame.index(0, j, k);
            for (int i = 0; i < size.x; ++i) {
                const float share = std::min(perLength * std::sqrt(sums.squaredLength(i)), 255.0f);
                to[i] = static_cast<std::uint8_t>(share + 0.5f);
            }
        }
    });
    return modulation;
}

}  // namespace stereonav
