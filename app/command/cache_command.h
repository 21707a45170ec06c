// What is kept between runs, and what it was made of.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// noteSource() (engine/base/cache.h) of a scene as it was named; nothing is noted of what is built in.
void noteSceneAsSource(const std::filesystem::path& file, const std::string& scene);

}  // namespace stereonav
