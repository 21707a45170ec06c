// The file forms of a centreline, for centreline_file.cpp. Text in, text out; millimetres in the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "colon/centreline/centreline.h"

namespace stereonav {

// Numbers in a text, one after another, with the line they stand on for what is wrong with them.
class NumberText {
public:
    NumberText(std::string file, std::string_view text, std::size_t firstLine = 1)
        : mFile(std::move(file)), mText(text), mFirstLine(firstLine) {}

    bool atEnd();                            // nothing but white space is left
    std::string_view word();                 // the next one; "" at the end
    double number(const std::string& what);  // finite. Throws Error
    // A count that the rest of the text can hold, each item taking two characters or more. Throws Error.
    std::size_t count(const std::string& what);
    std::string line() const;  // of the last word
    [[noreturn]] void fail(const std::string& problem) const;

private:
    std::string mFile;
    std::string_view mText;
    std::size_t mAt = 0, mWord = 0, mFirstLine;
};

// Points and the lines through them as poly data holds them, checked and put together into one line.
struct PolyLines {
    std::vector<double> coordinates, radii;       // three a point; one a point
    std::vector<std::vector<std::size_t>> lines;  // numbers of points
    std::vector<double> segments;                 // one a line, or none: counted from 1
};
Centreline centrelineFrom(const PolyLines& poly, const std::string& file);

// Where runs of one segment begin, and, last, the number of points.
std::vector<std::size_t> segmentStarts(const Centreline& line);

constexpr const char* kRadiusArray = "MaximumInscribedSphereRadius";
constexpr const char* kSegmentArray = "Segment";

std::string vtkText(const Centreline& line);  // legacy poly data
std::string vtpText(const Centreline& line);  // XML poly data
Centreline centrelineFromVtk(const std::string& text, const std::string& file);
Centreline centrelineFromVtp(const std::string& text, const std::string& file);

}  // namespace stereonav
