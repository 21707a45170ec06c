// The readers that are fuzzed: each as the program calls it, by a name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace stereonav::fuzz {

struct Reader {
    std::string_view name;
    const char* file;  // the input's name, whose extension chooses the format
    // May throw Error and Cancelled; whatever else leaves it is a finding.
    void (*read)(const std::filesystem::path& file);
    // Makes the checksums of an input fit it, so that more than the checksum is tried; null: there are none.
    void (*mend)(std::span<std::uint8_t> input) = nullptr;
};

std::span<const Reader> readers();

}  // namespace stereonav::fuzz
