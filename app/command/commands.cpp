#include "app/command/commands.h"

// The commands in the order of help; the file of each has a function `Command NAMECommand()`.
#define STEREONAV_COMMANDS(COMMAND) \
    COMMAND(info)                   \
    COMMAND(render)                 \
    COMMAND(play)                   \
    COMMAND(compare)                \
    COMMAND(report)                 \
    COMMAND(mesh)                   \
    COMMAND(viewshed)               \
    COMMAND(measure)                \
    COMMAND(profile)                \
    COMMAND(sun)                    \
    COMMAND(centreline)             \
    COMMAND(bake)                   \
    COMMAND(coverage)               \
    COMMAND(findings)               \
    COMMAND(register)               \
    COMMAND(unfold)                 \
    COMMAND(cache)                  \
    COMMAND(view)

namespace stereonav {

#define COMMAND(name) Command name##Command();
STEREONAV_COMMANDS(COMMAND)
#undef COMMAND

std::vector<Command> programCommands() {
#define COMMAND(name) name##Command(),
    return {STEREONAV_COMMANDS(COMMAND)};
#undef COMMAND
}

}  // namespace stereonav
