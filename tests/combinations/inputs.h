// Small inputs of every kind, written when first asked for, and the command line that a combination stands
// for.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tests/combinations/model.h"

namespace stereonav::test {

using Arguments = std::vector<std::string>;

class Inputs {
public:
    // Files are written into `folder`; run: the program, which must succeed, for what it makes itself (bakes,
    // a mesh).
    Inputs(std::filesystem::path folder, std::function<void(const Arguments&)> run)
        : mFolder(std::move(folder)), mRun(std::move(run)) {}

    // "render", scene and options, with --out picture.png. Makes the files that it names.
    Arguments commandLine(const Row& row);

private:
    std::string place(const std::string& name) const { return (mFolder / name).string(); }
    // Writes the file by `make` unless it is there; gives its whole name.
    std::string once(const std::string& name, const std::function<void(const std::string& file)>& make);

    std::string scene(const Row& row);
    std::string terrain(const std::string& name);
    std::string study(const std::string& name);
    std::string sceneFile(const Row& row);
    std::string photo();
    std::string sky(const std::string& level);
    std::string tower();
    std::string medium(const std::string& level);
    std::string bake(Row row);

    Arguments source(const Row& row);  // scene, and how it is read
    void addTerrain(const Row& row, Arguments& line);
    void addVolume(const Row& row, Arguments& line);
    void addLight(const Row& row, Arguments& line);
    void addMedium(const Row& row, Arguments& line);
    void addEyes(const Row& row, Arguments& line);

    std::filesystem::path mFolder;
    std::function<void(const Arguments&)> mRun;
    std::set<std::string> mMade;
};

// Returns the command line for a shell.
std::string shellLine(const Arguments& arguments);

}  // namespace stereonav::test
