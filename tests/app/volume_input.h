// Small studies for the real program: NRRD files written by hand from the format's description.
#pragma once

#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace stereonav::test {

struct SmallStudy {
    int width = 24, height = 24, depth = 24;
    double spacing_mm = 2;
    std::string type = "short";  // int16
    std::string extra;           // more header lines
};

class VolumeTest : public ProgramTest {
protected:
    // value(i, j, k) gives the samples.
    template <typename Value>
    std::string nrrd(const std::string& name, const SmallStudy& study, Value value) const {
        std::string samples;
        for (int k = 0; k < study.depth; ++k)
            for (int j = 0; j < study.height; ++j)
                for (int i = 0; i < study.width; ++i) {
                    const auto v = static_cast<std::int16_t>(value(i, j, k));
                    samples += static_cast<char>(v & 255);
                    if (study.type == "short") samples += static_cast<char>(v >> 8 & 255);
                }
        return input(name, header(study) + samples);
    }

    static std::string header(const SmallStudy& study) {
        std::ostringstream text;
        text << "NRRD0004\ntype: " << study.type << "\ndimension: 3\nsizes: " << study.width << ' '
             << study.height << ' ' << study.depth << "\nspace: left-posterior-superior\nspace directions: ("
             << study.spacing_mm << ",0,0) (0," << study.spacing_mm << ",0) (0,0," << study.spacing_mm
             << ")\nspace origin: (-24,-24,-24)\nencoding: raw\nendian: little\n"
             << study.extra << "\n";
        return text.str();
    }

    // A straight tube along z, closed at its ends, 14 mm wide in a block of 48 mm: a mask.
    static bool inTube(int i, int j, int k) {
        return std::hypot(2.0 * i - 23, 2.0 * j - 23) < 7 && k > 1 && k < 22;
    }
    std::string maskedTube() const {
        return nrrd("tube.nrrd", {24, 24, 24, 2, "uchar", ""},
                    [](int i, int j, int k) { return inTube(i, j, k) ? 1 : 0; });
    }
    // A ball of 1000 in 0, which is no CT of a body.
    std::string ball() const {
        return nrrd("ball.nrrd", {}, [](int i, int j, int k) {
            return std::max(0.0, 1000 - 60 * std::hypot(i - 11.5, j - 11.5, k - 11.5));
        });
    }
};

}  // namespace stereonav::test
