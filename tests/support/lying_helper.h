// A helper program that gives the answer that a test wants, instead of one of the program's own
// (tests/base/liar).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/base/helper_socket.h"
#include "engine/base/module.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav::test {

// Returns a message in the helpers' format; kind and length may differ from the true ones.
inline std::string helperMessage(const std::string& bytes, std::uint64_t kind = 0, std::int64_t length = -1) {
    const HelperHead head{length < 0 ? bytes.size() : static_cast<std::uint64_t>(length), kind};
    return std::string(reinterpret_cast<const char*>(&head), sizeof head) + bytes;
}

template <typename Structure>
std::string bytesOfStructure(const Structure& structure) {
    return std::string(reinterpret_cast<const char*>(&structure), sizeof structure);
}

class LyingHelper {
public:
    // Replaces stereonav_<name> during its life: each process that is started says this once, unchanged.
    LyingHelper(const std::string& name, const std::string& said) {
        std::ofstream(mFolder / "answer", std::ios::binary) << said;
        stand(name, mFolder / "answer");
    }
    // The same for a helper that ends by SIGKILL at each request.
    explicit LyingHelper(const std::string& name) { stand(name, mFolder / "nothing"); }
    ~LyingHelper() {
        unsetenv("STEREONAV_TEST_ANSWER");
        setModuleFolder("");
    }
    LyingHelper(const LyingHelper&) = delete;
    LyingHelper& operator=(const LyingHelper&) = delete;

private:
    void stand(const std::string& name, const std::filesystem::path& answer) {
        setenv("STEREONAV_TEST_ANSWER", answer.c_str(), 1);
        std::filesystem::create_symlink(moduleFolder() / "stereonav_test_liar",
                                        mFolder / ("stereonav_" + name));
        setModuleFolder(mFolder / "");
    }

    TemporaryFolder mFolder;
};

}  // namespace stereonav::test
