// Helpers (helper_program.h) of one kind, started as they are asked for: one for each thread that asks at
// once. One that gave an answer is kept for the next request and ends with the pool; one that met damage
// keeps what it took for it, and is not asked again.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/helper_program.h"

namespace stereonav {

class HelperPool {
public:
    // Name and purpose are HelperProgram's. mostIdle: number of idle helpers that are kept at most.
    HelperPool(std::string name, std::string purpose, std::size_t mostIdle);

    // Asks a helper, from any thread. A helper that has seen what comes from one folder sees nothing from
    // another: whoever took it over by a file may not change what is read of somebody else's. Throws Error
    // where none can be started, and Cancelled.
    HelperAnswer ask(const std::filesystem::path& folder, std::string_view request,
                     const HelperLimits& limits);

private:
    struct Idle {
        std::filesystem::path folder;
        std::unique_ptr<HelperProgram> helper;
    };
    std::unique_ptr<HelperProgram> take(const std::filesystem::path& folder);
    void keep(Idle idle);

    const std::string mName, mPurpose;
    const std::size_t mMostIdle;
    std::mutex mLock;
    std::vector<Idle> mIdle;
};

}  // namespace stereonav
