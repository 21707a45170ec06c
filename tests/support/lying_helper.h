// A helper program that answers what a test wants, in the place of one of the program's own
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

// A message as helpers send it; kind and length may be others than what there is.
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
    // Stands in for stereonav_<name> while it lives: each that is started says this once, as it is.
    LyingHelper(const std::string& name, const std::string& said) {
        std::ofstream(mFolder / "answer", std::ios::binary) << said;
        stand(name, mFolder / "answer");
    }
    // The same for one that ends by SIGKILL over each request.
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
