// How well lines of generated colons are registered that were bent and inflated differently, over many seeds:
//   bench_colon_register [SEEDS [LARGEST_SIDE]]
// The error is that of each polyp's place, along the second line. Beside it that of the share of the length
// alone. Last the costs of one colon and of two: what tells them apart (kMostCostOfOneColon).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "colon/instruments/finding.h"
#include "colon/instruments/registration.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/error.h"

namespace {

using namespace stereonav;

ColonScene made(std::uint64_t seed, int side, double bend, double inflation) {
    Progress progress;
    ColonOptions options;
    options.builtIn.seed = seed;
    options.builtIn.size = {side, side, side * 411 / 512};
    options.builtIn.bend = bend;
    options.builtIn.inflation = inflation;
    return loadColon(options, progress);
}

struct Pair {
    ColonScene straight, bent;
};

// None where a colon comes out of the body that it is bent in: that is said.
std::optional<Pair> pairOf(std::uint64_t seed, int side, double bend, double inflation) {
    try {
        return Pair{made(seed, side, 0, 1), made(seed, side, bend, inflation)};
    } catch (const Error& error) {
        fmt::print("seed {} bend {:g} inflation {:g}: left out: {}\n", seed, bend, inflation, error.what());
        return std::nullopt;
    }
}

// Sorts them.
void printCosts(const char* what, std::vector<double>& costs) {
    if (costs.empty()) return;
    std::sort(costs.begin(), costs.end());
    const std::size_t last = costs.size() - 1;
    fmt::print(
        "{}: {} pairs, cost {:.3f} at least, 5 of 100 {:.3f}, median {:.3f}, 95 of 100 {:.3f}, {:.3f} at "
        "most\n",
        what, costs.size(), costs.front(), costs[last * 5 / 100], costs[last / 2], costs[last * 95 / 100],
        costs.back());
}

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 5, side = argc > 2 ? std::atoi(argv[2]) : 256;
    std::vector<Centreline> lines;
    std::vector<int> owners;  // seeds
    std::vector<double> same, other;
    for (const auto& [bend, inflation] :
         {std::pair(0.0, 1.15), std::pair(0.006, 0.9), std::pair(0.012, 1.0), std::pair(0.02, 1.3)}) {
        std::vector<double> errors, shares;
        for (int seed = 1; seed <= seeds; ++seed) {
            const auto n = static_cast<std::uint64_t>(seed);
            const std::optional<Pair> pair = pairOf(n, side, bend, inflation);
            if (!pair) continue;
            const auto& [a, b] = *pair;
            const LineRegistration registration(a.centreline, b.centreline);
            same.push_back(registration.cost());
            lines.push_back(b.centreline);
            owners.push_back(seed);
            for (std::size_t k = 0; k < std::min(a.polyps.size(), b.polyps.size()); ++k) {
                const double first = alongLine(a.centreline, a.polyps[k].position);
                const double truth = alongLine(b.centreline, b.polyps[k].position);
                errors.push_back(1e3 * std::abs(registration.toSecond(first) - truth));
                shares.push_back(1e3 *
                                 std::abs(first / a.centreline.length() * b.centreline.length() - truth));
            }
            fmt::print(
                "seed {} bend {:g} inflation {:g}: {:.0f} mm and {:.0f} mm, {} and {} pieces, cost {:.3f}\n",
                seed, bend, inflation, 1e3 * a.centreline.length(), 1e3 * b.centreline.length(),
                a.lumen.segments.size(), b.lumen.segments.size(), registration.cost());
        }
        if (errors.empty()) continue;
        std::sort(errors.begin(), errors.end());
        std::sort(shares.begin(), shares.end());
        const auto mean = [](const std::vector<double>& all) {
            double sum = 0;
            for (const double one : all) sum += one / static_cast<double>(all.size());
            return sum;
        };
        fmt::print(
            "bend {:g} mm, inflation {:g}: mean {:.1f} mm, median {:.1f}, 95 of 100 {:.1f}, most {:.1f}; "
            "by the share of the length {:.1f}, {:.1f}, {:.1f}, {:.1f}\n",
            1e3 * bend, inflation, mean(errors), errors[errors.size() / 2], errors[errors.size() * 95 / 100],
            errors.back(), mean(shares), shares[shares.size() / 2], shares[shares.size() * 95 / 100],
            shares.back());
    }
    for (std::size_t a = 0; a < lines.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const double cost = LineRegistration(lines[a], lines[b]).cost();
            (owners[a] == owners[b] ? same : other).push_back(cost);
        }
    printCosts("one colon", same);
    printCosts("two colons", other);
    return 0;
}
