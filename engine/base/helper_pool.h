// Helpers (helper_program.h) of one kind, started when they are needed: as many as threads ask at the same
// time. A helper that gave an answer is kept for the next request, until the pool ends or it makes room for
// another. One that refused, as over damaged data, is ended at once, and its memory with it.
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

    // Asks a helper, from any thread. folder: where the request's data come from. A helper is asked about
    // one folder only: a malicious file that took it over can then not falsify what is read from another
    // folder. Throws Error where no helper can be started, and Cancelled.
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
