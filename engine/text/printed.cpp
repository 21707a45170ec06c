#include "engine/text/printed.h"

#include <string>

#include "engine/text/printable.h"

namespace stereonav {
namespace {

// In one piece: processes may share where it goes. What could not be written the stream itself remembers, and
// main() tells at the end, when all that was made is in its place.
void put(std::FILE* to, const std::string& text) {
    std::fputs(text.c_str(), to);
}

}  // namespace

void printLine(std::FILE* to, std::string_view line) {
    put(to, printable(line, kLongestLine) + "\n");
}

void printLines(std::FILE* to, std::string_view lines) {
    put(to, printableLines(lines));
}

void printDocument(std::string_view document) {
    put(stdout, std::string(document) + "\n");
}

void printNote(std::string_view note) {
    printLine(stderr, "stereonav: " + std::string(note));
}

}  // namespace stereonav
