// Entry of the program: parses the command line, and turns every error into one line and exit status 1.
#include <cstdio>
#include <exception>
#include <new>

#include "app/command/arguments.h"
#include "app/command/commands.h"
#include "app/command/process_facts.h"
#include "app/command/together.h"
#include "engine/base/error.h"
#include "engine/base/stop.h"

int main(int argc, char** argv) {
    stereonav::noteStart();
    stereonav::catchStopSignals();
    try {
        stereonav::joinOthers(argc, argv);
        stereonav::setCommands(stereonav::programCommands());
        const int status = stereonav::runCommandLine(argc, argv);
        // A run fails where its output can not be written.
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw stereonav::Error("standard output", "", "can not be written", "is the disk full?");
        stereonav::leaveOthers();
        return status;
    } catch (const stereonav::Cancelled&) {
        return stereonav::endStopped();
    } catch (const std::bad_alloc&) {
        return stereonav::endWith("there is not enough memory; free some, or ask for less");
    } catch (const std::exception& error) {
        return stereonav::endWith(error.what());
    }
}
