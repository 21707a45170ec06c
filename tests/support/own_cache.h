// Keeps files of tests out of the user's cache: in a folder of the build, which all tests share, so that
// built-in scenes are made once. Tests of the cache itself set one of their own.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace stereonav::test {

inline void useOwnCache() {
    const std::filesystem::path cache = STEREONAV_TEST_CACHE;
    std::error_code code;
    std::filesystem::create_directories(cache, code);
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
}

// Including this header is enough.
inline const bool kOwnCacheUsed = (useOwnCache(), true);

}  // namespace stereonav::test
