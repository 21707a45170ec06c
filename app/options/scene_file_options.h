// What a scene file says of options: under [options] every one that tells of the scene and of how it looks
// has the key that it has on the command line. `scene = "study.nrrd"` in its first lines makes it the file of
// a study or medium; without it the file is a terrain's (terrain/read/scene_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereonav {

struct SceneFileOption {
    std::string key;
    std::vector<std::string> texts;  // as the command line has them: several where it is repeated
    bool isFlag = false;             // true or false in the file
    int line = 0;
};

struct SceneFileOptions {
    std::string scene;  // with its folder, or a built-in one's name; "": the file is a terrain's
    std::vector<SceneFileOption> options;
};

// Throws Error: unknown keys all together, each with line and the nearest known one; what is no TOML.
SceneFileOptions readSceneFileOptions(const std::filesystem::path& toml);

}  // namespace stereonav
