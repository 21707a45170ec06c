// What a command tells of what it did: lines for people, or with --json one document, or with --quiet
// nothing.
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
    // outputs: where the command's files go; lines go to standard error where one of them is standard output.
    // Throws Error where two go to the same place, the document among them.
    CommandResult(const char* command, const Telling& telling, const std::vector<NamedPlace>& outputs);

    // A line for people, with its end.
    void say(std::string_view line) const;
    // A line of what was asked to be printed: for people also where they want no notes.
    void answer(std::string_view line) const;

    // A field of the document: its name ends with its unit. No number is null.
    void add(std::string key, FactValue value);
    // The scene by its name alone (handed_name.h): documents are handed on.
    void addScene(const std::string& scene);
    // A file that was written, or a folder; of a stream its size is null.
    void addFile(const std::string& key, const std::filesystem::path& file);
    // Prints the document, once.
    void finish() const;
    // Writes it into a file, whatever --json says of standard output. Throws Error.
    void writeTo(const std::filesystem::path& file) const;

private:
    Telling mTelling;
    std::FILE* mLines;
    Facts mFacts;
};

// The document on standard output.
void printJson(const Facts& facts);

}  // namespace stereonav
