// `stereonav cache` as plain options and one function, as commands.h has the other commands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/command/commands.h"

namespace stereonav {

struct CacheOptions {
    Telling telling;
    bool clear = false;
    std::string older;  // "30d": what was last used before that is removed; "": whatever its age
    std::string of;  // a study or file, or a folder of some: what was made of it is removed; "": of anything
};
int runCache(const CacheOptions& options);

// Hours of "12h", "30d" or "4w"; none: it is none of these.
std::optional<double> hoursOfAge(const std::string& text);

// noteSource() (engine/base/cache.h) of a scene as it was named; nothing is noted of what is built in.
void noteSceneAsSource(const std::filesystem::path& file, const std::string& scene);

}  // namespace stereonav
