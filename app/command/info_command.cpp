// `stereonav info`: prints what was read, the frame plan, and what the program has started for it.
#include <cstdio>

#include "app/command/info_series.h"
#include "app/command/process_facts.h"
#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/output/command_result.h"
#include "app/output/handed_name.h"
#include "app/output/progress_bar.h"
#include "app/scene/frame_facts.h"
#include "app/scene/scene_loading.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

// Returns the defaults of `info`: it tells of what is shown, and measures frames without detail.
SceneOptions toldSceneOptions() {
    SceneOptions options;
    options.chosenLook = true;
    return options;
}

struct InfoOptions {
    SceneOptions scene = toldSceneOptions();
    SizeOption size;
    Telling telling;
    // Folder for a preview of each series of a DICOM folder, which is then the only result; "": none.
    std::string series;
};

int runInfo(const InfoOptions& options) {
    if (!options.series.empty()) return listSeries(options.scene, options.series, options.telling.json);
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

std::vector<Option> infoOptions() {
    return {
        {.key = "series-pictures",
         .value = fileValue(),
         .help = "only list the series of a DICOM folder, and write a picture of each into this folder",
         .scenes = scene_type::kStudies,
         .elsewhere = {nullptr, "needs a folder of DICOM slices", "name one, or leave it out"},
         .take = into<&InfoOptions::series>},
    };
}

}  // namespace

Command infoCommand() {
    return {.name = "info",
            .help = "print what was read and the frame plan",
            .scenes = scene_type::kAll,
            .command = command::kInfo,
            .traits = command::kShowing | command::kTelling,
            .chapter = Chapter::Series,
            .options = infoOptions,
            .start = startOf<InfoOptions, runInfo>};
}

}  // namespace stereonav
