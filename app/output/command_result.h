// The output of a command: lines of text, or with --json one document, or with --quiet nothing.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/output_place.h"
#include "app/options/shared_options.h"
#include "engine/scene/facts.h"

namespace stereonav {

class CommandResult {
public:
    // outputs: the command's files; lines of text go to standard error where one of them is standard output.
    // Throws Error where two outputs, or an output and the document, go to the same place.
    CommandResult(const char* command, const Telling& telling, const std::vector<NamedPlace>& outputs);

    // Prints a line of text, which has to end with a newline.
    void say(std::string_view line) const;
    // Prints a line that the user has asked for, even with --quiet.
    void answer(std::string_view line) const;

    // Adds a field to the document; the name ends with the unit. NaN becomes null.
    void add(std::string key, FactValue value);
    // Adds the scene's name without its folder (handed_name.h): documents are passed on.
    void addScene(const std::string& scene);
    // Adds a file or folder that was written; the size of a stream is null.
    void addFile(const std::string& key, const std::filesystem::path& file);
    // Prints the document; to be called once.
    void finish() const;
    // Writes the document into a file, independent of --json. Throws Error.
    void writeTo(const std::filesystem::path& file) const;

private:
    Telling mTelling;
    std::FILE* mLines;
    Facts mFacts;
};

// Prints the document on standard output.
void printJson(const Facts& facts);

}  // namespace stereonav
