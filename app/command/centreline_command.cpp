// `stereonav centreline`: writes the way through a colon as a file for other tools.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/inside.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

struct CentrelineOptions {
    SceneOptions scene;
    Telling telling;
    std::string out;  // .vtp, .vtk or .txt
};

void checkCentrelineOptions(const CentrelineOptions& options) {
    if (!isStandardOutput(options.out) && !isCentrelineFileName(options.out))
        throw Error("--out", "", "expected a file named .txt, .vtp or .vtk, got \"" + options.out + "\"",
                    "name it centreline.vtp");
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    checkOutputFile("--out", options.out);
    expectColonName(options.scene.scene);
}

int runCentreline(const CentrelineOptions& options) {
    checkCentrelineOptions(options);
    CommandResult result("centreline", options.telling, {{"--out", options.out}});
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> scene = loadScene(options.scene, SizeOption{}, bar.progress(), kNoPicture);
    checkNotRead({{"--out", options.out}});
    const auto* const colon = scene->offered<const ColonInterior>();
    if (!colon)
        throw Error(options.scene.scene, "", "no colon was found, so there is no centreline",
                    "give --seed x,y,z inside it");
    const Centreline& line = colon->centreline();
    writeCentreline(options.out, line);
    bar.clear();
    const auto narrower = [](const CentrelinePoint& a, const CentrelinePoint& b) {
        return a.radius < b.radius;
    };
    const auto [least, most] = std::minmax_element(line.points.begin(), line.points.end(), narrower);
    result.say(fmt::format("{}: {} points along {:.1f} mm in {} segment(s), radius {:.1f} to {:.1f} mm\n",
                           options.out, line.points.size(), line.length() * 1e3, colon->segments(),
                           least->radius * 1e3, most->radius * 1e3));
    result.addScene(scene->name);
    result.addFile("centreline", options.out);
    result.add("points", static_cast<std::int64_t>(line.points.size()));
    result.add("length_mm", line.length() * 1e3);
    result.add("segments", static_cast<std::int64_t>(colon->segments()));
    result.add("least_radius_mm", least->radius * 1e3);
    result.add("largest_radius_mm", most->radius * 1e3);
    result.finish();
    return 0;
}

std::vector<Option> centrelineOptions() {
    return {
        {.key = "out",
         .value = fileValue(),
         .help =
             "file of the line, .vtp or .vtk (poly data) or .txt, or -; millimetres, LPS, from the rectum",
         .required = true,
         .take = into<&CentrelineOptions::out>},
    };
}

}  // namespace

Command centrelineCommand() {
    return {.name = "centreline",
            .help = "write the centreline of a colon, with its radii",
            .scenes = scene_type::kVolumes,
            .traits = command::kOfColon | command::kTelling,
            .chapter = Chapter::Shapes,
            .options = centrelineOptions,
            .start = startOf<CentrelineOptions, runCentreline>};
}

}  // namespace stereonav
