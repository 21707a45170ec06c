// `stereonav info`: prints what was read, the frame plan, and what the program has started for it.
#include <cstdio>

#include "app/command/info_series.h"
#include "app/command/process_facts.h"
#include "app/options/command.h"
#include "app/options/picture_options.h"
#include "app/output/command_result.h"
#include "app/output/handed_name.h"
#include "app/output/progress_bar.h"
#include "app/scene/frame_facts.h"
#include "app/scene/scene_loading.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {
int runInfo(const InfoOptions& options) {
    if (!options.series.empty()) return listSeriesOf(options);
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> loaded = loadScene(options.scene, options.size, bar.progress(), kInfoBytes);
    const Scene& scene = *loaded;
    ProcessFacts process;
    takeWhenReady(process);
    bar.progress().report(0.95, "measuring");
    const std::optional<FramePlan> plan = planScene(scene);
    takeAtEnd(process);
    bar.clear();
    Facts facts = scene.describe();
    facts.push_back(factForAll("plan", factsOfFrames(scene, plan), "frame plan"));
    facts.push_back(factForAll("process", factsOf(process), "process"));
    if (options.telling.json) {
        facts.insert(facts.begin(), factForJson("scene", handedName(scene.name)));
        printJson(facts);
        return 0;
    }
    printLine(stdout, scene.name);
    printLines(stdout, linesOf(facts));
    return 0;
}

}  // namespace

Command infoCommand() {
    return {.name = "info",
            .help = "print what was read and the frame plan",
            .scenes = scene_type::kAll,
            .command = command::kInfo,
            .traits = command::kShowing | command::kTelling,
            .start = startOf<InfoOptions, runInfo>};
}

}  // namespace stereonav
