// Parts of the program that pull in big libraries (GDAL, GDCM, OpenCV) are modules: shared objects in
// lib/stereonav, beside the program's bin, that are opened when one of their functions is first called. A
// room keeps its functions as they are declared; in its own sources they only hand on to the module's table
// of them.
//
//   program, room/x.cpp              static const auto& table = moduleFunctions<Table>("name", "what it
//   does"); module, room/<library>/x.cpp     the functions themselves, and stereonavModule with the table
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stereonav {

// What a module shows the program: the symbol stereonavModule. Both are of one build, so that types of C++
// can cross: strings, arrays, exceptions.
struct ModuleEntry {
    const char* build;               // moduleBuild()
    std::size_t size;                // bytes of the table
    const void* functions;           // the table
    void (*shareLoops)(void* from);  // parallel.h: the program's threads do the module's loops
};

// The module's side: `const ModuleEntry stereonavModule = moduleEntry(kTable);`.
extern "C" {
[[gnu::visibility("default")]] extern const ModuleEntry stereonavModule;
}
// Returns what tells this build from others.
const char* moduleBuild();
// Lets the module's loops run on the program's threads (parallel.h).
void shareLoopsOf(void* program);
// Returns the entry of a module whose table of functions is `functions`.
template <typename Functions>
ModuleEntry moduleEntry(const Functions& functions) {
    return {moduleBuild(), sizeof functions, &functions, shareLoopsOf};
}

// The table of the module stereonav_<name>, which stays loaded. purpose completes "it is needed ...". Throws
// Error naming the file where the module, or a library that it needs, is missing, or it is of another build.
const void* moduleTable(const std::string& name, const std::string& purpose, std::size_t size);
// Returns the same table by its type.
template <typename Functions>
const Functions& moduleFunctions(const std::string& name, const std::string& purpose) {
    return *static_cast<const Functions*>(moduleTable(name, purpose, sizeof(Functions)));
}

// Returns whether the module's file is there; nothing is loaded.
bool hasModule(const std::string& name);

// The program's own file: as the system says, or, where no /proc is mounted, as it was started. "" where
// neither tells. root: where proc is; another one for tests.
std::filesystem::path programFile(const std::filesystem::path& root = "/");

// Where modules are: ../lib/stereonav from the program's own folder, so that it can be moved as a whole.
std::filesystem::path moduleFolder();
// Sets the folder, for programs that lie elsewhere: before the first call of a module's function, while no
// other thread runs.
void setModuleFolder(const std::filesystem::path& folder);

// The files of all shared libraries that this process has loaded, itself left out.
std::vector<std::string> loadedLibraries();

}  // namespace stereonav
