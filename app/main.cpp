// The program's entry: parses the command line and turns every error into one line and exit status 1.
#include <cstdio>
#include <exception>

#include "app/arguments.h"
#include "app/process_facts.h"
#include "engine/base/error.h"

int main(int argc, char** argv) {
    stereonav::noteStart();
    try {
        return stereonav::runCommandLine(argc, argv);
    } catch (const stereonav::Cancelled&) {
        std::fprintf(stderr, "stereonav: stopped\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stereonav: %s\n", error.what());
    }
    return 1;
}
