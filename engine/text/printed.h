// Output of the program on standard output and standard error. All of it goes through here, but for what a
// document has in its own form (JSON, CSV, SVG): whatever a line holds, it is text alone (printable.h).
#pragma once

#include <cstdio>
#include <string_view>

namespace stereonav {

// Prints one line; its end is added.
void printLine(std::FILE* to, std::string_view line);
// Prints lines that the program has laid out. A word from a file that stands in them is printable() before: a
// line that it breaks would look as one of the program's own.
void printLines(std::FILE* to, std::string_view lines);
// Prints a document that is text in a form of its own, which lets nothing else through (json_text.h); its end
// is added.
void printDocument(std::string_view document);
// Prints "stereonav: note" on standard error.
void printNote(std::string_view note);

}  // namespace stereonav
