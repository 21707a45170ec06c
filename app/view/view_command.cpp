// The command that opens the window.
#include "app/view/view_command.h"

#include "app/options/output_place.h"
#include "app/scene/scene_loading.h"
#include "app/scene/shown_as.h"
#include "app/view/viewer.h"

namespace stereonav {

int runView(const ViewOptions& options) {
    checkSize(options.size, options.scene, kNoPicture);
    checkMethod(options.scene, options.method);
    if (!options.shots.empty()) checkOutputFolder("--shots", options.shots);
    if (!options.json.empty()) checkOutputFile("--json", options.json);
    checkNoInput({"--json", options.json}, inputsOf(options.scene));
    ViewOptions shown = options;
    shown.scene.skyTurns = !shownAs(options.scene).swept;  // a medium's keys turn its own light
    shown.scene.detailLater = true;
    shown.scene.standInFirst = !options.bench;
    // What is measured does not depend on how far light is that is worked out meanwhile.
    if (options.bench) shown.scene.lightLater = false;
    if (options.bench && !shown.scene.given.has("ground-detail")) shown.scene.groundDetail = false;
    Viewer(shown).run();
    return 0;
}

}  // namespace stereonav
