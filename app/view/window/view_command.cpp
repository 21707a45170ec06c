// The command `view`, which opens the window.
#include "app/view/window/view_command.h"

#include "app/options/output_place.h"
#include "app/scene/scene_loading.h"
#include "app/scene/shown_as.h"
#include "app/view/window/viewer.h"

namespace stereonav {

int runView(const ViewOptions& options) {
    checkSize(options.size, options.scene, kNoPicture);
    checkMethod(options.scene, options.method);
    if (!options.shots.empty()) checkOutputFolder("--shots", options.shots);
    if (!options.json.empty()) checkOutputFile("--json", options.json);
    checkNoInput({"--json", options.json}, inputsOf(options.scene));
    ViewOptions shown = options;
    shown.scene.skyTurns = !shownAs(options.scene).swept;  // keys turn a medium's own light
    shown.scene.detailLater = true;
    shown.scene.standInFirst = !options.bench;
    // Measurements do not depend on the progress of light that is computed meanwhile.
    if (options.bench) shown.scene.lightLater = false;
    if (options.bench && !shown.scene.given.has("ground-detail")) shown.scene.groundDetail = false;
    Viewer(shown).run();
    return 0;
}

}  // namespace stereonav
