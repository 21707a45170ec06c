// What programs that are started ask for of memory, noted by them.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace stereonav::test {

// While it lives, programs that are started add a line to the file each time that they ask for memory.
class AskedMemory {
public:
    explicit AskedMemory(const std::string& file)
        : mFile(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600)) {  // given on to programs
        setenv("STEREONAV_MEMORY_ASKED", std::to_string(mFile).c_str(), 1);
    }
    ~AskedMemory() {
        unsetenv("STEREONAV_MEMORY_ASKED");
        close(mFile);
    }
    AskedMemory(const AskedMemory&) = delete;
    AskedMemory& operator=(const AskedMemory&) = delete;

private:
    int mFile;
};

}  // namespace stereonav::test
