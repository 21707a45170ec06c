// `stereonav unfold`: the wall of a colon laid flat, as a picture.
#include <fmt/format.h>

#include <algorithm>

#include "app/command/colon_commands.h"
#include "app/command/colon_of.h"
#include "app/command/findings_words.h"
#include "app/output/command_result.h"
#include "app/output/output_place.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "colon/instruments/unfolding.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

void checkUnfoldOptions(const UnfoldOptions& options) {
    expectColonName(options.scene.scene);
    for (const auto& [option, file] : {std::pair("--out", options.out), std::pair("--map", options.map)}) {
        if (file.empty()) continue;
        checkOutputPicture(option, file);
        checkNoInput({option, file}, inputsOf(options.scene));
    }
}

// How the polyps of a generated colon are shown.
void tellPolyps(CommandResult& result, const ColonScene& colon, const WallMesh& wall,
                const WallNeighbours& neighbours, const UnfoldedWall& unfolded) {
    if (colon.polyps.empty()) return;
    std::vector<Facts> list;
    int once = 0;
    for (const Polyp& truth : colon.polyps) {
        std::string why;
        const auto polyp =
            polypAt(wall, neighbours, truth.position, polypSettingOf(colon.volume.field.frame), why);
        Facts facts{factForJson("truth_mm", 1e3 * truth.diameter),
                    factForJson("truth_shape", std::string(nameOf(truth.shape)))};
        if (polyp) {
            const UnfoldedWall::Shown shown = unfolded.shown(*polyp);
            const glm::dvec2 at = unfolded.pixelOf(polyp->tip);
            once += shown.share > 0 && shown.pieces == 1;
            facts.push_back(factForJson("shown_percent", 100 * shown.share));
            facts.push_back(factForJson("pieces", static_cast<std::int64_t>(shown.pieces)));
            facts.push_back(factForJson("pixel", FactNumbers{at.x, at.y}));
        }
        list.push_back(std::move(facts));
    }
    result.say(fmt::format("  {} of {} polyps are shown once and whole\n", once, colon.polyps.size()));
    result.add("polyps", std::move(list));
}

}  // namespace

int runUnfold(const UnfoldOptions& options) {
    checkUnfoldOptions(options);
    CommandResult result("unfold", options.telling, {{"--out", options.out}, {"--map", options.map}});
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> scene = loadScene(options.scene, SizeOption{}, bar.progress(), kNoPicture);
    checkNotRead({{"--out", options.out}, {"--map", options.map}});
    const ColonScene& colon = colonOf(*scene, options.scene);
    const WallMesh wall = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, bar.progress());
    const WallNeighbours neighbours = neighboursOf(wall);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    UnfoldSetting setting;
    setting.pixel = 1e-3 * options.pixel_mm;
    const UnfoldedWall unfolded(wall, neighbours, colon.centreline, sight, setting, bar.progress());
    writeColorImage(options.out, unfolded.picture(colon.volume.look));
    if (!options.map.empty()) writeColorImage(options.map, unfolded.distortionMap());
    bar.clear();
    const UnfoldedWall::AreaError error = unfolded.areaError();
    result.say(fmt::format(
        "{}: {}x{} pixels of {:g} mm; areas of square centimetres are off by {:.0f} % on average, 95 of "
        "100 by {:.0f} % at most; {}\n",
        options.out, unfolded.width(), unfolded.height(), options.pixel_mm, 100 * error.mean,
        100 * error.most95, kNoMedicalDevice));
    result.add("scene", scene->name);
    result.addFile("picture", options.out);
    if (!options.map.empty()) result.addFile("map", options.map);
    result.add("size", FactIntegers{unfolded.width(), unfolded.height()});
    result.add("pixel_mm", options.pixel_mm);
    result.add("area_error_percent", 100 * error.mean);
    result.add("area_error_95_percent", 100 * error.most95);
    tellPolyps(result, colon, wall, neighbours, unfolded);
    result.finish();
    return 0;
}

}  // namespace stereonav
