// What is looked at in a header before a library reads it. The libraries behind ITK and GDCM print complaints
// of their own, go on for ever or end the program over some of what damaged files hold (found by damaging
// files at random); here it becomes one line that names the place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "colon/study_parts.h"

namespace stereonav {
namespace {
constexpr std::uint32_t kLongestMetaElement = 1 << 20;  // of a DICOM file's group 2: names and versions
}  // namespace

// Group 2 (PS3.10, 7.1): elements of a tag, two capitals that name their kind of value, and a length.
void checkDicomMeta(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<char, 132> preamble{};
    if (!in.read(preamble.data(), preamble.size()) || std::memcmp(preamble.data() + 128, "DICM", 4) != 0)
        return;
    const auto damaged = [&](std::streamoff at) {
        throw Error(file.string(), fmt::format("byte {}", at), "the DICOM header is damaged",
                    "copy the file again");
    };
    std::array<unsigned char, 8> head{};
    for (;;) {
        const std::streamoff at = in.tellg();
        if (!in.read(reinterpret_cast<char*>(head.data()), head.size())) damaged(at);
        if (head[0] != 2 || head[1] != 0) return;
        const char kind[3] = {static_cast<char>(head[4]), static_cast<char>(head[5]), '\0'};
        static constexpr const char* kShort[] = {"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                 "FD", "FL", "IS", "LO", "LT", "PN", "SH",
                                                 "SL", "SS", "ST", "TM", "UI", "UL", "US"};
        static constexpr const char* kLong[] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                "SV", "UC", "UN", "UR", "UT", "UV"};
        const auto named = [&](const char* name) { return std::strcmp(kind, name) == 0; };
        std::uint32_t length = head[6] | static_cast<std::uint32_t>(head[7]) << 8;
        if (std::any_of(std::begin(kLong), std::end(kLong), named)) {
            std::array<unsigned char, 4> bytes{};
            if (!in.read(reinterpret_cast<char*>(bytes.data()), bytes.size())) damaged(at);
            length = bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
        } else if (std::none_of(std::begin(kShort), std::end(kShort), named)) {
            damaged(at);
        }
        if (length > kLongestMetaElement || !in.ignore(length) || in.gcount() != length) damaged(at);
    }
}

}  // namespace stereonav
