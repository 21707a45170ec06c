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

// What a module offers the program: the symbol stereonavModule. Module and program are of one build, so that
// C++ types can be passed between them: strings, arrays, exceptions.
struct ModuleEntry {
    const char* build;               // moduleBuild()
    std::size_t size;                // bytes of the table
    const void* functions;           // the table
    void (*shareLoops)(void* from);  // lets the module's loops run on the program's threads (parallel.h)
};

// The module's side: `const ModuleEntry stereonavModule = moduleEntry(kTable);`.
extern "C" {
[[gnu::visibility("default")]] extern const ModuleEntry stereonavModule;
}
// Returns an identifier of this build, which differs from that of other builds.
const char* moduleBuild();
// Lets the module's loops run on the program's threads (parallel.h).
void shareLoopsOf(void* program);
// Returns the entry of a module whose table of functions is `functions`.
template <typename Functions>
ModuleEntry moduleEntry(const Functions& functions) {
    return {moduleBuild(), sizeof functions, &functions, shareLoopsOf};
}

// Returns the table of the module stereonav_<name>, which stays loaded. purpose completes "it is needed ...".
// Throws Error naming the file where the module, or a library that it needs, is missing, or where the module
// is of another build.
const void* moduleTable(const std::string& name, const std::string& purpose, std::size_t size);
// Returns the same table as a reference of its type.
template <typename Functions>
const Functions& moduleFunctions(const std::string& name, const std::string& purpose) {
    return *static_cast<const Functions*>(moduleTable(name, purpose, sizeof(Functions)));
}

// Returns whether the module's file exists; loads nothing.
bool hasModule(const std::string& name);

// Returns the program's own file as the system names it, or, where /proc is not mounted, the path that it was
// started with. "" where neither is known. root: folder that holds proc; tests give another one.
std::filesystem::path programFile(const std::filesystem::path& root = "/");

// Returns the folder of the modules: ../lib/stereonav from the program's own folder, so that both can be
// moved together.
std::filesystem::path moduleFolder();
// Sets the folder of the modules, for programs that lie elsewhere. To be called before the first call of a
// module's function, while no other thread runs.
void setModuleFolder(const std::filesystem::path& folder);

// Returns the files of all shared libraries that this process has loaded, without the program itself.
std::vector<std::string> loadedLibraries();

}  // namespace stereonav
