// Bakes a volume's light: goes on from the file of the same bake, or begins; writes the file at the end, when
// stopped, and every two minutes.
#include "app/command/bake_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/command/cache_command.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/light_loading.h"
#include "app/scene/volume/volume_loading.h"
#include "engine/base/error.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"
#include "engine/light/bake/bake_job.h"
#include "engine/peers/peers.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

constexpr int kSamples = 256;  // default

BakeGoal goalOf(const BakeOptions& options) {
    BakeGoal goal;
    goal.samples = options.samples.value_or(options.error || options.minutes ? 0 : kSamples);
    goal.error = options.error.value_or(0);
    goal.minutes = options.minutes.value_or(0);
    return goal;
}

// Returns the sums in the file of this bake, or empty ones. Names a file that can not be used.
BakeSums begin(const std::filesystem::path& file, std::uint64_t key, VolumeBakePlan& plan,
               const TexelLighter& lighter, bool tell, ProgressBar& bar) {
    std::string problem;
    if (auto kept = readBakeFile(file, key, problem)) return std::move(kept->sums);
    if (!problem.empty() && tell) {
        bar.clear();
        printNote(fmt::format("{}: {}; it is baked again", file.string(), problem));
    }
    return BakeSums(plan.inputs.texels, std::move(plan.bricks), plan.inputs.shape, lighter.bytesToCome());
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

// Reports samples and time of the run, and the file.
void tellOf(CommandResult& result, const std::string& scene, const VolumeBakePlan& plan, const BakeSums& sums,
            double done, double seconds, const std::filesystem::path& file) {
    const double each = samplesIn(sums) / std::max<double>(1, static_cast<double>(sums.texels()));
    // In a bake that was stopped some texels have more samples than others.
    result.say(fmt::format("{}: {} of {} texels, {:.0f} samples each{}, {}\n", scene,
                           nameOf(sums.shape().kind), sums.texels(), each,
                           each > sums.fewestSamples() ? " on average" : "", errorText(sums.error())));
    for (const std::string& note : plan.notes) result.say("  " + note + "\n");
    if (done > 0)
        result.say(
            fmt::format("  {:.1f} s, {:.0f} samples a second\n", seconds, done / std::max(seconds, 1e-9)));
    else
        result.say("  nothing was to be done\n");
    result.say(fmt::format("  {}: {:.1f} MB\n", file.string(),
                           static_cast<double>(std::filesystem::file_size(file)) / 1e6));
    result.addScene(scene);
    result.add("what", std::string(nameOf(sums.shape().kind)));
    result.addFile("light", file);
    result.add("baked_before", done <= 0);
    result.add("texels", static_cast<std::int64_t>(sums.texels()));
    result.add("samples_per_texel", each);
    result.add("error_percent", 100 * sums.error());
    result.add("time_s", seconds);
    result.add("samples_per_s", done / std::max(seconds, 1e-9));
    result.add("notes", plan.notes);
}

}  // namespace

int bakeVolume(const BakeOptions& options) {
    Peers& peers = peersOfThisRun();
    if (peers.first()) checkBakeOptions(options);
    CommandResult result("bake", options.telling, {});
    ProgressBar bar(peers.first() && !options.telling.quiet);
    Progress& progress = bar.progress();
    checkSceneOptions(options.scene);
    const LitVolume loaded = litVolumeOf(options.scene, progress);
    const ColonScene& scene = loaded.world->colon();
    VolumeBakePlan plan = planVolumeBake(scene, options, progress);
    const TexelLighter lighter(scene.volume.field, plan.inputs.texels, plan.inputs.light,
                               plan.inputs.sampling);
    const FinishingWork keepsWhatIsDone;  // a stop ends the bake like its goal
    if (!peers.first()) {
        BakeSums sums(plan.inputs.texels, std::move(plan.bricks), plan.inputs.shape, lighter.bytesToCome());
        serveBake(sums, sourceOf(lighter), peers);
        return 0;
    }
    const BakeIdentity identity{bakeKey(plan.inputs), plan.inputs.content};
    const std::filesystem::path file =
        options.out.empty() ? bakeCacheFile(identity.key) : std::filesystem::path(options.out);
    BakeSums sums = begin(file, identity.key, plan, lighter, !options.telling.quiet, bar);
    const double before = samplesIn(sums);
    BakeKeeping keeping;
    keeping.keep = [&](const BakeSums& now) { writeBakeFile(file, identity, now); };
    const Stopwatch watch;
    const BakeEnd end = runBake(sums, sourceOf(lighter), goalOf(options), progress, keeping, &peers);
    const double seconds = watch.elapsed_ms() / 1000, done = samplesIn(sums) - before;
    if (done > 0 || !std::filesystem::exists(file)) writeBakeFile(file, identity, sums);
    noteSceneAsSource(file, options.scene.scene);
    bar.clear();
    peers.throwIfFailed();
    tellOf(result, options.scene.scene, plan, sums, done, seconds, file);
    result.add("stopped", end == BakeEnd::Cancelled);
    result.finish();
    if (end == BakeEnd::Cancelled)
        printNote("stopped; what is done is kept, and the next run goes on from there");
    return end == BakeEnd::Cancelled ? 1 : 0;
}

}  // namespace stereonav
