// The program's output on standard output and standard error. All of it goes through here, except documents
// in their own form (JSON, CSV, SVG): every line is made printable (printable.h).
#pragma once

#include <cstdio>
#include <string_view>

namespace stereonav {

// Prints one line and a line end.
void printLine(std::FILE* to, std::string_view line);
// Prints lines that the program has laid out. Words from files in them must have been made printable()
// before: a line break in one would look like a line of the program.
void printLines(std::FILE* to, std::string_view lines);
// Prints a document in a form of its own that is already printable (json_text.h), and a line end.
void printDocument(std::string_view document);
// Prints "stereonav: note" on standard error.
void printNote(std::string_view note);

}  // namespace stereonav
