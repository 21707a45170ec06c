// Whether a classic netCDF file is whole: its library takes what is cut off for zeros, without a word, and
// takes the memory that a header asks for, however damaged it is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace stereonav {

// Bytes that the file has to have, by its header ("CDF" 1, 2 or 5), more than any file has where the header
// is damaged; none where it is no such file.
std::optional<std::uint64_t> classicNetCdfSize(const std::filesystem::path& file);

}  // namespace stereonav
