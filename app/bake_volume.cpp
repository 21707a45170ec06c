// Goes on from what the file of the same bake holds, or begins; writes the file when done, stopped, and every
// two minutes between.
#include "app/bake_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/light_loading.h"
#include "app/progress_bar.h"
#include "app/scene_loading.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/light/bake_job.h"

namespace stereonav {
namespace {

constexpr int kSamples = 256;  // where nothing is said

BakeGoal goalOf(const BakeOptions& options) {
    BakeGoal goal;
    goal.samples = options.samples.value_or(options.error || options.minutes ? 0 : kSamples);
    goal.error = options.error.value_or(0);
    goal.minutes = options.minutes.value_or(0);
    return goal;
}

// What the file holds of this bake, or nothing done yet. A file that can not be used is named.
BakeSums begin(const std::filesystem::path& file, std::uint64_t key, VolumeBakePlan& plan, ProgressBar& bar) {
    std::string problem;
    if (auto kept = readBakeFile(file, key, problem)) return std::move(kept->sums);
    if (!problem.empty()) {
        bar.clear();
        std::fprintf(stderr, "stereonav: %s: %s; it is baked anew\n", file.c_str(), problem.c_str());
    }
    return BakeSums(plan.inputs.texels, std::move(plan.bricks), plan.inputs.shape);
}

std::string errorText(double error) {
    return std::isfinite(error) ? fmt::format("error {:.2g} %", 100 * error) : "error not known";
}

double samplesIn(const BakeSums& sums) {
    double all = 0;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n)
        all += static_cast<double>(sums.samples[n]) * static_cast<double>(sums.texelsOf(n));
    return all;
}

}  // namespace

int bakeVolume(const BakeOptions& options) {
    checkBakeOptions(options);
    ProgressBar bar;
    SceneOptions shown = options.scene;
    shown.sky.clear();  // here a colour
    const LoadedScene scene = loadScene(shown, SizeOption{}, bar.progress());
    VolumeBakePlan plan = planVolumeBake(*scene.colon, options, bar.progress());
    const BakeIdentity identity{bakeKey(plan.inputs), plan.inputs.content};
    const std::filesystem::path file =
        options.out.empty() ? bakeCacheFile(identity.key) : std::filesystem::path(options.out);
    BakeSums sums = begin(file, identity.key, plan, bar);
    const double before = samplesIn(sums);
    const TexelLighter lighter(scene.colon->volume.field, plan.inputs.texels, plan.inputs.light,
                               plan.inputs.sampling);
    BakeKeeping keeping;
    keeping.keep = [&](const BakeSums& now) { writeBakeFile(file, identity, now); };
    const Stopwatch watch;
    const BakeEnd end = runBake(sums, sourceOf(lighter), goalOf(options), bar.progress(), keeping);
    const double seconds = watch.elapsed_ms() / 1000, done = samplesIn(sums) - before;
    if (done > 0 || !std::filesystem::exists(file)) writeBakeFile(file, identity, sums);
    bar.clear();
    std::printf("%s: %s of %zu texels, %u samples each, %s\n", scene.name.c_str(),
                std::string(nameOf(sums.shape().kind)).c_str(), sums.texels(), sums.fewestSamples(),
                errorText(sums.error()).c_str());
    for (const std::string& note : plan.notes) std::printf("  %s\n", note.c_str());
    if (done > 0)
        std::printf("  %.1f s, %.0f samples a second\n", seconds, done / std::max(seconds, 1e-9));
    else
        std::printf("  nothing was to be done\n");
    std::printf("  %s: %.1f MB\n", file.c_str(), static_cast<double>(std::filesystem::file_size(file)) / 1e6);
    if (end != BakeEnd::Cancelled) return 0;
    std::fprintf(stderr, "stereonav: stopped; what is done is kept, and the next run goes on from there\n");
    return 1;
}

}  // namespace stereonav
