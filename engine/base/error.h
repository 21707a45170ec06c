// The exception for errors that a person can act on. It says which file, which place in it, what was expected
// and found, and what to do. Libraries throw it, and app/ reports it.
#pragma once

#include <stdexcept>
#include <string>

namespace stereonav {

class Error : public std::runtime_error {
public:
    // file:    the file or option the problem is in, "" when there is none
    // place:   where in it: "12" (a line), "\"spacing\"" (a key), "band 1"; "" when the whole file
    // problem: one clause, "expected a positive number, got -3"
    // advice:  one clause, what to do; "" only when the problem says it already
    Error(const std::string& file, const std::string& place, const std::string& problem,
          const std::string& advice)
        : std::runtime_error(oneLine(file, place, problem, advice)) {}

private:
    static std::string oneLine(const std::string& file, const std::string& place, const std::string& problem,
                               const std::string& advice) {
        std::string line = file;
        if (!place.empty()) line += (line.empty() ? "" : ":") + place;
        if (!line.empty()) line += ": ";
        line += problem;
        if (!advice.empty()) line += "; " + advice;
        for (char& c : line)
            if (c == '\n' || c == '\r') c = ' ';
        return line;
    }
};

// Thrown where the disk reports an error while a file is read. The file may be intact, so unlike a damaged
// file it must not be made again.
class DiskError : public Error {
public:
    explicit DiskError(const std::string& file)
        : Error(file, "", "can not be read to its end: the disk reports an error",
                "copy it to another disk, or name another") {}
};

// Thrown out of a long job when its Progress was cancelled.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace stereonav
