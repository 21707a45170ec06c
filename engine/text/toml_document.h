// Reads a TOML file key by key and collects problems: callers ask for the keys that they know, and keys that
// nobody asked for are unknown. Independent of scenes. Keeps the TOML library out of headers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/text/number_range.h"

namespace stereonav {

class TomlSection;

class TomlDocument {
public:
    // Throws Error when the file can not be read, is no TOML or is larger than a scene can be.
    explicit TomlDocument(const std::filesystem::path& file);
    ~TomlDocument();
    TomlDocument(const TomlDocument&) = delete;
    TomlDocument& operator=(const TomlDocument&) = delete;

    // Returns the table [name]; an empty one when the file has none.
    TomlSection section(const std::string& name);
    // Returns a text before the first section; "" where there is none.
    std::string rootText(const std::string& key);
    // Returns the tables [[name]], in the order of the file.
    std::vector<TomlSection> sections(const std::string& name);

    // Throws one Error: for all keys that were never asked for, each with its line and the nearest
    // known one; else for the first wrong value.
    void finish() const;
    // Does the same for one section. Throws Error.
    void finishSection(const std::string& name) const;

private:
    friend class TomlSection;
    struct State;
    std::unique_ptr<State> mState;
};

// Each read() leaves `value` as it is when the key is absent or its value wrong; the latter is noted in the
// document. Numbers must be finite. The document must outlive this object.
class TomlSection {
public:
    bool has(const std::string& key) const;
    void read(const std::string& key, bool& value);
    void read(const std::string& key, std::string& value);  // not empty
    void read(const std::string& key, double& value, const NumberRange& range);
    // all of them or none
    void read(const std::string& key, std::span<double> values, const NumberRange& range);
    void read(const std::string& key, std::int64_t& value, std::int64_t low, std::int64_t high);
    // Degrees in the file, radians in `value`.
    void readDegrees(const std::string& key, double& value, const NumberRange& rangeDegrees);

    // Returns a value in the form of the command line: a list of numbers is one text, with commas
    // between them; a list of anything else one text for each. Returns nothing where the key is absent.
    std::vector<std::string> texts(const std::string& key);
    // Returns whether the value is true or false.
    bool isFlag(const std::string& key) const;
    // Returns the key's line, from 1; 0 where the key is absent.
    int line(const std::string& key) const;
    // Leaves this table's keys to other code, which knows them.
    void leave();

    // Notes a problem at the key (or, without it, at the section's line).
    void note(const std::string& key, const std::string& problem, const std::string& advice);

private:
    friend class TomlDocument;
    struct Place;
    TomlSection(TomlDocument::State& document, std::string name, const void* table)
        : mDocument(&document), mName(std::move(name)), mTable(table) {}

    TomlDocument::State* mDocument;
    std::string mName;
    const void* mTable;  // the library's table, null when the file has none
};

}  // namespace stereonav
