// Lets libFuzzer try a reader: the input becomes a file in memory, which is read as the program reads it.
// STEREONAV_FUZZ_READER names the reader.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "tests/fuzz/readers.h"

namespace {
namespace fs = std::filesystem;
using stereonav::fuzz::Reader;

const Reader* chosen = nullptr;

// A folder of this process's own, in memory where the system has such a place. It holds the input and the
// cache.
class Scratch {
public:
    Scratch() {
        std::string name = (fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                           "stereonav-fuzz-XXXXXX";
        if (!mkdtemp(name.data())) std::abort();
        mFolder = name;
        setenv("XDG_CACHE_HOME", name.c_str(), 1);
        fs::create_directories((mFolder / chosen->file).parent_path());
    }
    ~Scratch() {
        std::error_code code;
        fs::remove_all(mFolder, code);
    }
    fs::path file(const std::vector<std::uint8_t>& input) const {
        fs::path place = mFolder / chosen->file;
        const int out = open(place.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (out < 0 || write(out, input.data(), input.size()) != static_cast<ssize_t>(input.size()) ||
            close(out) != 0)
            std::abort();
        return place;
    }

private:
    fs::path mFolder;
};

// What a person is told: something, in one line.
void checkMessage(const std::string& message) {
    if (!message.empty() && message.find('\n') == std::string::npos) return;
    std::fprintf(stderr, "a message that is no line: \"%s\"\n", message.c_str());
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    const char* name = std::getenv("STEREONAV_FUZZ_READER");
    for (const Reader& reader : stereonav::fuzz::readers())
        if (name && reader.name == name) chosen = &reader;
    if (chosen) return 0;
    std::fprintf(stderr, "STEREONAV_FUZZ_READER: expected one of");
    for (const Reader& reader : stereonav::fuzz::readers())
        std::fprintf(stderr, " %.*s", static_cast<int>(reader.name.size()), reader.name.data());
    std::fprintf(stderr, "\n");
    std::exit(1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Scratch scratch;
    std::vector<std::uint8_t> input(data, data + size);
    if (chosen->mend) chosen->mend(input);
    try {
        chosen->read(scratch.file(input));
    } catch (const stereonav::Error& error) {
        checkMessage(error.what());
    } catch (const stereonav::Cancelled&) {
    }
    return 0;
}
