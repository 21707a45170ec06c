// Modules are opened with dlopen and never closed: what their libraries registered lives as long as the
// program.
#include "engine/base/module.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/auxv.h>

#include <string_view>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEntry = "stereonavModule";

fs::path& chosenFolder() {  // empty: none
    static fs::path folder;
    return folder;
}

Error cannotLoad(const fs::path& file, const std::string& purpose, const std::string& reason) {
    return Error(file.string(), "", "can not be loaded (" + reason + "); it is needed " + purpose,
                 "install the library that is missing, or build the program again");
}

const ModuleEntry& open(const fs::path& file, const std::string& purpose) {
    std::error_code code;
    if (!fs::exists(file, code))
        throw Error(
            file.string(), "", "there is no such module of the program; it is needed " + purpose,
            "build the target " + file.stem().string() + ", or install the program with its lib folder");
    // Lazily: what a module itself needs is bound when it is loaded (it is linked so); what the libraries
    // behind it could need costs more than they do.
    void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!library) throw cannotLoad(file, purpose, dlerror());
    const void* entry = dlsym(library, kEntry);
    if (!entry) throw cannotLoad(file, purpose, "it is no module of this program");
    return *static_cast<const ModuleEntry*>(entry);
}

}  // namespace

const char* moduleBuild() {
    return "stereonav " STEREONAV_VERSION ", compiler " __VERSION__;
}

void shareLoopsOf(void* program) {
    shareLoops(program);
}

const void* moduleTable(const std::string& name, const std::string& purpose, std::size_t size) {
    const fs::path file = moduleFolder() / ("stereonav_" + name + ".so");
    const ModuleEntry& module = open(file, purpose);
    if (std::string_view(module.build) != moduleBuild() || module.size != size)
        throw cannotLoad(file, purpose, "it is of another build than the program");
    module.shareLoops(loopsOfThisProgram());
    return module.functions;
}

bool hasModule(const std::string& name) {
    std::error_code code;
    return fs::is_regular_file(moduleFolder() / ("stereonav_" + name + ".so"), code);
}

void setModuleFolder(const fs::path& folder) {
    chosenFolder() = folder;
}

fs::path programFile(const fs::path& root) {
    std::error_code code;
    fs::path program = fs::read_symlink(root / "proc/self/exe", code);
    if (!code) return program;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): getauxval returns the address as a number.
    const auto* const started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
    return started ? fs::canonical(started, code) : fs::path();
}

fs::path moduleFolder() {
    if (!chosenFolder().empty()) return chosenFolder();
    return programFile().parent_path().parent_path() / "lib" / "stereonav";
}

std::vector<std::string> loadedLibraries() {
    std::vector<std::string> files;
    const auto add = [](dl_phdr_info* info, std::size_t, void* to) {
        const std::string_view name = info->dlpi_name;
        if (name.find('/') != std::string_view::npos)  // neither the program ("") nor the kernel's own page
            static_cast<std::vector<std::string>*>(to)->emplace_back(name);
        return 0;
    };
    dl_iterate_phdr(add, &files);
    return files;
}

}  // namespace stereonav
