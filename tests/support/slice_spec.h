// A DICOM slice as tests describe it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

namespace stereonav::test {

struct SliceSpec {
    std::string uid = "1.2.3.1", description = "made for a test", modality = "CT";
    std::string photometric = "MONOCHROME2";
    int columns = 6, rows = 5;
    glm::dvec3 position{10, 20, 30};  // millimetres, LPS
    glm::dvec3 along{1, 0, 0}, down{0, 1, 0};
    glm::dvec2 spacing{0.8, 0.7};  // millimetres between columns, between rows
    std::string slope = "1", intercept = "-1024";
    bool isSigned = false;
    int bitsStored = 16;
    int padding = -1;                   // below 0: none
    std::vector<std::uint16_t> pixels;  // empty: all 1024
};

inline std::string numbersText(std::initializer_list<double> numbers) {
    std::ostringstream text;
    text.precision(10);
    for (const double x : numbers) text << (text.tellp() > 0 ? "\\" : "") << x;
    return text.str();
}

}  // namespace stereonav::test
