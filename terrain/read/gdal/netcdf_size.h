// Checks whether a classic netCDF file is complete: its library reads missing parts as zeros, without an
// error, and takes as much memory as a header asks for, even a damaged one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace stereonav {

// Returns the bytes that the file must have by its header ("CDF" 1, 2 or 5); where the header is damaged,
// more than any file has; empty for other files.
std::optional<std::uint64_t> classicNetCdfSize(const std::filesystem::path& file);

}  // namespace stereonav
