// The program's entry: parses the command line and turns every error into one line and exit status 1.
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "app/command/process_facts.h"
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
        const int status = stereonav::runCommandLine(argc, argv);
        // What was printed has arrived, or the run has failed.
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw stereonav::Error("standard output", "", "can not be written", "is the disk full?");
        return status;
    } catch (const stereonav::Cancelled&) {
        std::fprintf(stderr, "stereonav: stopped\n");
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "stereonav: there is not enough memory; free some, or ask for less\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stereonav: %s\n", printable(error.what()).c_str());
    }
    return 1;
}
