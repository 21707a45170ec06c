// Notes on the sources of what is kept between runs.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Calls noteSource() (engine/base/cache.h) with the scene's file; built-in scenes are not noted.
void noteSceneAsSource(const std::filesystem::path& file, const std::string& scene);

}  // namespace stereonav
