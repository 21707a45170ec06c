#include "colon/instruments/candidates.h"

#include <algorithm>
#include <string>

namespace stereonav {
namespace {

constexpr const char* kLookingForTips = "looking for candidates";

// Returns, for each cluster of vertices that may be tips, the one that bulges most.
std::vector<std::uint32_t> tipsOf(const WallNeighbours& neighbours, const std::vector<Curvatures>& curvatures,
                                  const CandidateSetting& setting) {
    std::vector<std::uint8_t> open(curvatures.size());
    for (std::size_t v = 0; v < curvatures.size(); ++v) {
        const double curved = curvatures[v].curvedness();
        open[v] = curvatures[v].shapeIndex() >= setting.shapeIndex && curved >= setting.leastCurved &&
                  curved <= setting.mostCurved;
    }
    std::vector<std::uint32_t> tips, cluster;
    for (std::uint32_t start = 0; start < open.size(); ++start) {
        if (!open[start]) continue;
        cluster.assign(1, start);
        open[start] = 0;
        std::uint32_t best = start;
        for (std::size_t n = 0; n < cluster.size(); ++n) {
            if (curvatures[cluster[n]].smaller > curvatures[best].smaller) best = cluster[n];
            for (std::uint32_t k = neighbours.first[cluster[n]]; k < neighbours.first[cluster[n] + 1]; ++k)
                if (const std::uint32_t next = neighbours.neighbours[k]; open[next])
                    open[next] = 0, cluster.push_back(next);
        }
        constexpr std::size_t kLeast = 4;  // vertices: fewer are noise
        if (cluster.size() >= kLeast) tips.push_back(best);
    }
    return tips;
}

}  // namespace

std::vector<Candidate> polypCandidates(const WallMesh& mesh, const WallNeighbours& neighbours,
                                       const CandidateSetting& setting, Progress* progress) {
    Progress quiet;
    Progress& told = progress ? *progress : quiet;
    told.report(0, kLookingForTips);
    const std::vector<Curvatures> curvatures =
        wallCurvatures(mesh, neighbours, setting.polyp.curvatureRadius);
    std::vector<Candidate> found;
    std::vector<std::uint8_t> taken(mesh.places.size(), 0);
    const std::vector<std::uint32_t> tips = tipsOf(neighbours, curvatures, setting);
    std::size_t done = 0;
    for (const std::uint32_t tip : tips) {
        told.report(static_cast<double>(done++) / static_cast<double>(tips.size()), kLookingForTips);
        if (taken[tip]) continue;  // it is on a head that was found from another tip
        std::string why;
        auto polyp = polypAt(mesh, neighbours, tip, setting.polyp, why);
        if (!polyp || taken[polyp->tip]) continue;
        for (const std::uint32_t v : polyp->vertices) taken[v] = 1;
        const double wide = polyp->widest.length, score = polyp->score();
        if (wide < setting.leastWide || wide > setting.mostWide || score < setting.leastScore) continue;
        found.push_back({std::move(*polyp), score});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    told.report(1, kLookingForTips);
    return found;
}

}  // namespace stereonav
