// `stereonav view`, in builds with and without the window.
#include "app/view/window/view_command.h"

#include "app/options/command.h"

namespace stereonav {

Command viewCommand() {
    return {.name = "view",
            .help = "fly through the scene in a window",
            .scenes = scene_type::kAll,
            .command = command::kView,
            .traits = command::kShowing,
            .start = startOf<ViewOptions, runView>};
}

}  // namespace stereonav
