// Lets libFuzzer try the command line of `render`, which has nearly all options: words end at zero bytes.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/command/arguments.h"
#include "engine/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> words;
    std::string text(reinterpret_cast<const char*>(data), size);
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\0', from), text.size());
        words.push_back(text.substr(from, end - from));
        from = end + 1;
    }
    try {
        stereonav::renderOptionsFrom(words);
    } catch (const stereonav::Error& error) {
        if (std::string(error.what()).empty()) std::abort();
    }
    return 0;
}
