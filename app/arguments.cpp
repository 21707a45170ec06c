// The command line, through CLI11.
#include "app/arguments.h"

#include <CLI/CLI.hpp>

#include "app/commands.h"

namespace stereonav {

int runCommandLine(int argc, char** argv) {
    CLI::App app{"Stereo flight through terrain, with the second eye warped and measured", "stereonav"};
    app.set_version_flag("--version", "stereonav 0.1.0");
    CLI11_PARSE(app, argc, argv);
    return 0;
}

}  // namespace stereonav
