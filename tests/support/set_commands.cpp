// Hands the program's commands to the table of options before any test begins, as main() does.
#include "app/command/commands.h"

namespace stereonav::test {
namespace {

[[maybe_unused]] const bool kCommandsAreSet = (setCommands(programCommands()), true);

}  // namespace
}  // namespace stereonav::test
