// The program's entry: parses the command line and turns every error into one line and exit status 1.
#include <cstdio>
#include <exception>
#include <string>

#include "app/arguments.h"
#include "app/process_facts.h"
#include "engine/base/error.h"

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
    try {
        return stereonav::runCommandLine(argc, argv);
    } catch (const stereonav::Cancelled&) {
        std::fprintf(stderr, "stereonav: stopped\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stereonav: %s\n", printable(error.what()).c_str());
    }
    return 1;
}
