// The program's entry: parses the command line and turns every error into one line and exit status 1.
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "app/command/process_facts.h"
#include "app/command/together.h"
#include "app/options/arguments.h"
#include "engine/base/error.h"
#include "engine/base/stop.h"

namespace {

// Text out of a damaged file may hold anything: no byte of it breaks the line or moves the cursor.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    stereonav::noteStart();
    stereonav::catchStopSignals();
    try {
        stereonav::joinOthers(argc, argv);
        const int status = stereonav::runCommandLine(argc, argv);
        // What was printed has arrived, or the run has failed.
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw stereonav::Error("standard output", "", "can not be written", "is the disk full?");
        stereonav::leaveOthers();
        return status;
    } catch (const stereonav::Cancelled&) {
        return stereonav::endStopped();
    } catch (const std::bad_alloc&) {
        return stereonav::endWith("there is not enough memory; free some, or ask for less");
    } catch (const std::exception& error) {
        return stereonav::endWith(printable(error.what()));
    }
}
