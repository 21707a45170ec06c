// Conjugate gradients with a multigrid preconditioner. Coarse levels join 2 x 2 samples into one with
// the sums of their couplings (plain aggregation: Notay, An aggregation-based algebraic multigrid
// method, ETNA 2010, section 2); any shape of hole coarsens that way without special cases. Joined
// samples move as one block, which is too stiff: the correction is scaled up, and each level is
// visited twice (a W cycle) where that paper solves each by a few Krylov steps.
#include "terrain/ground/membrane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace stereonav {
namespace {

constexpr double kRelativeError = 1e-8;  // residual over that of the guess
constexpr int kMostIterations = 200;
constexpr float kStiffness = 1.8f;     // overcorrection; 2 is exact for long waves in one dimension
constexpr std::size_t kSmallest = 32;  // unknowns of the last level
constexpr int kSweepsOnSmallest = 16;

enum Direction { kWest, kEast, kSouth, kNorth };
constexpr std::int32_t kNone = -1;

// The unknowns of one level with their couplings. `fixed` couples to known samples.
struct Level {
    std::vector<std::array<std::int32_t, 4>> neighbors;
    std::vector<std::array<float, 4>> weights;  // 0 where there is no neighbour
    std::vector<float> fixed;
    std::vector<std::int32_t> parent;  // on the next level
    std::vector<float> x, b;           // scratch of a cycle

    std::size_t size() const { return fixed.size(); }
    // In double: rounded to float it would not be the sum of the couplings any more, and a row sum that
    // is off by 1e-7 bends the membrane by that times the square of the hole's width.
    double diagonal(std::size_t k) const {
        double sum = fixed[k];
        for (const float w : weights[k]) sum += w;
        return sum;
    }
    template <typename Vector>
    auto pull(const Vector& v, std::size_t k) const {
        typename Vector::value_type sum = 0;
        for (int n = 0; n < 4; ++n)
            if (neighbors[k][n] != kNone) sum += weights[k][n] * v[neighbors[k][n]];
        return sum;
    }
    void resize(std::size_t count) {
        neighbors.assign(count, {kNone, kNone, kNone, kNone});
        weights.assign(count, {0, 0, 0, 0});
        fixed.assign(count, 0.0f);
    }
};

// Where the unknowns lie, in ascending row-major order.
struct Cells {
    int width, height;
    std::vector<std::size_t> places;

    std::int32_t find(std::size_t place) const {
        const auto at = std::lower_bound(places.begin(), places.end(), place);
        return at != places.end() && *at == place ? static_cast<std::int32_t>(at - places.begin()) : kNone;
    }
};

Level finestLevel(const Cells& cells, const glm::dvec2& spacing) {
    const double x = 1 / (spacing.x * spacing.x), y = 1 / (spacing.y * spacing.y), most = std::max(x, y);
    const float across = static_cast<float>(x / most), along = static_cast<float>(y / most);
    const float weight[4] = {across, across, along, along};
    const std::size_t w = static_cast<std::size_t>(cells.width),
                      last = static_cast<std::size_t>(cells.height) - 1;
    Level level;
    level.resize(cells.places.size());
    for (std::size_t k = 0; k < cells.places.size(); ++k) {
        const std::size_t place = cells.places[k], i = place % w, j = place / w;
        const bool inside[4] = {i > 0, i + 1 < w, j > 0, j < last};
        const std::size_t other[4] = {place - 1, place + 1, place - w, place + w};
        for (int n = 0; n < 4; ++n) {
            if (!inside[n]) continue;
            level.neighbors[k][n] = cells.find(other[n]);
            (level.neighbors[k][n] == kNone ? level.fixed[k] : level.weights[k][n]) += weight[n];
        }
    }
    return level;
}

Level coarser(Level& fine, const Cells& fineCells, Cells& cells) {
    cells.width = (fineCells.width + 1) / 2;
    cells.height = (fineCells.height + 1) / 2;
    const std::size_t fineWidth = static_cast<std::size_t>(fineCells.width);
    const auto parentPlace = [&](std::size_t place) {
        return place / fineWidth / 2 * cells.width + place % fineWidth / 2;
    };
    cells.places.reserve(fine.size());
    for (const std::size_t place : fineCells.places) cells.places.push_back(parentPlace(place));
    std::sort(cells.places.begin(), cells.places.end());
    cells.places.erase(std::unique(cells.places.begin(), cells.places.end()), cells.places.end());
    fine.parent.reserve(fine.size());
    for (const std::size_t place : fineCells.places) fine.parent.push_back(cells.find(parentPlace(place)));
    Level level;
    level.resize(cells.places.size());
    for (std::size_t k = 0; k < fine.size(); ++k) {
        const std::int32_t parent = fine.parent[k];
        level.fixed[parent] += fine.fixed[k];
        for (int n = 0; n < 4; ++n) {
            const std::int32_t other = fine.neighbors[k][n];
            if (other == kNone || fine.parent[other] == parent) continue;
            level.neighbors[parent][n] = fine.parent[other];
            level.weights[parent][n] += fine.weights[k][n];
        }
    }
    return level;
}

class Multigrid {
public:
    Multigrid(Cells cells, const glm::dvec2& spacing) {
        mLevels.push_back(finestLevel(cells, spacing));
        while (mLevels.back().size() > kSmallest) {
            Cells coarse{};
            Level next = coarser(mLevels.back(), cells, coarse);
            if (next.size() == mLevels.back().size()) break;  // scattered single samples: nothing to join
            mLevels.push_back(std::move(next));
            cells = std::move(coarse);
        }
        for (Level& level : mLevels) {
            level.x.resize(level.size());
            level.b.resize(level.size());
        }
    }

    const Level& finest() const { return mLevels.front(); }

    // z = an approximate inverse applied to r, symmetric and positive.
    void precondition(const std::vector<double>& r, std::vector<double>& z) {
        Level& level = mLevels.front();
        for (std::size_t k = 0; k < r.size(); ++k) level.b[k] = static_cast<float>(r[k]);
        std::fill(level.x.begin(), level.x.end(), 0.0f);
        cycle(0);
        for (std::size_t k = 0; k < r.size(); ++k) z[k] = level.x[k];
    }

private:
    static void relax(Level& level, std::size_t k) {
        level.x[k] = (level.b[k] + level.pull(level.x, k)) / static_cast<float>(level.diagonal(k));
    }
    static void sweepForward(Level& level) {
        for (std::size_t k = 0; k < level.size(); ++k) relax(level, k);
    }
    static void sweepBackward(Level& level) {
        for (std::size_t k = level.size(); k-- > 0;) relax(level, k);
    }

    // Improves x of this level for its b; as many sweeps back as forth keep it symmetric.
    void cycle(std::size_t l) {
        Level& level = mLevels[l];
        if (l + 1 == mLevels.size()) {
            for (int sweep = 0; sweep < kSweepsOnSmallest; ++sweep) {
                sweepForward(level);
                sweepBackward(level);
            }
            return;
        }
        sweepForward(level);
        Level& coarse = mLevels[l + 1];
        std::fill(coarse.x.begin(), coarse.x.end(), 0.0f);
        std::fill(coarse.b.begin(), coarse.b.end(), 0.0f);
        for (std::size_t k = 0; k < level.size(); ++k)
            coarse.b[level.parent[k]] += kStiffness * (level.b[k] + level.pull(level.x, k) -
                                                       static_cast<float>(level.diagonal(k)) * level.x[k]);
        cycle(l + 1);
        if (l > 0) cycle(l + 1);
        for (std::size_t k = 0; k < level.size(); ++k) level.x[k] += coarse.x[level.parent[k]];
        sweepBackward(level);
    }

    std::vector<Level> mLevels;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

// Returns how strongly the samples around pull at each missing one, with the guess in place.
std::vector<double> residualOf(const std::vector<std::size_t>& missing, const std::vector<float>& heights,
                               int width, int height, const glm::dvec2& spacing) {
    const double x = 1 / (spacing.x * spacing.x), y = 1 / (spacing.y * spacing.y), most = std::max(x, y);
    const std::size_t w = static_cast<std::size_t>(width), last = static_cast<std::size_t>(height) - 1;
    std::vector<double> residual;
    residual.reserve(missing.size());
    for (const std::size_t at : missing) {
        const double here = heights[at];
        double sum = 0;
        if (at % w > 0) sum += x * (heights[at - 1] - here);
        if (at % w + 1 < w) sum += x * (heights[at + 1] - here);
        if (at / w > 0) sum += y * (heights[at - w] - here);
        if (at / w < last) sum += y * (heights[at + w] - here);
        residual.push_back(sum / most);
    }
    return residual;
}

}  // namespace

void solveMembrane(const std::vector<std::size_t>& missing, std::vector<float>& heights, int width,
                   int height, const glm::dvec2& spacing, Progress& progress) {
    progress.report(0, "filling missing samples");
    Multigrid multigrid({width, height, missing}, spacing);
    const Level& level = multigrid.finest();
    std::vector<double> r = residualOf(missing, heights, width, height, spacing);
    std::vector<double> x(r.size(), 0.0), z(r.size()), p(r.size(), 0.0), ap(r.size());
    const double enough = dot(r, r) * kRelativeError * kRelativeError;
    double before = 0;
    for (int iteration = 0; iteration < kMostIterations && dot(r, r) > enough; ++iteration) {
        progress.report(iteration / double(kMostIterations), "filling missing samples");
        multigrid.precondition(r, z);
        const double rz = dot(r, z), turn = before > 0 ? rz / before : 0.0;
        before = rz;
        for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + turn * p[k];
        for (std::size_t k = 0; k < p.size(); ++k) ap[k] = level.diagonal(k) * p[k] - level.pull(p, k);
        const double pap = dot(p, ap);
        if (!(pap > 0)) break;  // rounding: nothing more to gain
        const double step = rz / pap;
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += step * p[k];
            r[k] -= step * ap[k];
        }
    }
    for (std::size_t k = 0; k < missing.size(); ++k) heights[missing[k]] += static_cast<float>(x[k]);
    progress.report(1, "filling missing samples");
}

}  // namespace stereonav
