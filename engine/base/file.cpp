#include "engine/base/file.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"

namespace stereonav {
namespace fs = std::filesystem;

std::string readTextFile(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code))
        throw Error(path.string(), "", "expected a file, found a folder", "name the file itself");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error(path.string(), "", "can not be opened", "check the name and its permissions");
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    fs::path temporary = path;
    temporary.replace_filename("." + path.stem().string() + "." + std::to_string(getpid()) + ".part" +
                               path.extension().string());
    try {
        write(temporary);
        fs::rename(temporary, path);
    } catch (const fs::filesystem_error&) {
        fs::remove(temporary, code);
        throw Error(path.string(), "", "can not be written",
                    "check that the folder exists and has room and write permission");
    } catch (...) {
        fs::remove(temporary, code);
        throw;
    }
}

void writeTextFile(const fs::path& path, const std::string& content) {
    writeFileAtomically(path, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << content;
        out.close();
        if (!out)
            throw Error(path.string(), "", "can not be written",
                        "check that the folder exists and has room and write permission");
    });
}

fs::path cacheFolder() {
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) return fs::path(xdg) / "stereonav";
    if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "stereonav";
    return fs::temp_directory_path() / "stereonav-cache";
}

}  // namespace stereonav
