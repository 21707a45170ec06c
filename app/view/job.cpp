#include "app/view/job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/thread_priority.h"

extern char** environ;

namespace stereonav {
namespace {

constexpr const char* kOften = "STEREONAV_PROGRESS_SECONDS=0.2";  // see app/output/progress_bar.cpp

Error noProcess(int code) {
    return {"", "window", std::string("no process can be started: ") + std::strerror(code),
            "close other programs and try again"};
}

// Ignores SIGPIPE in the process: writing fails when nobody reads any more, but does not end the process
// before it has tidied up.
struct WithoutPipeSignal {
    WithoutPipeSignal() {
        sigset_t blocked;
        pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        sigaddset(&blocked, SIGPIPE);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setsigmask(&attributes, &blocked);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    }
    ~WithoutPipeSignal() { posix_spawnattr_destroy(&attributes); }
    WithoutPipeSignal(const WithoutPipeSignal&) = delete;
    WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

    posix_spawnattr_t attributes;
};

}  // namespace

bool progressOf(const std::string& line, double& fraction, std::string& words) {
    std::size_t at = line.find(" % ");
    if (at == std::string::npos || at == 0) return false;
    std::size_t from = at;
    while (from > 0 && line[from - 1] >= '0' && line[from - 1] <= '9') --from;
    if (from == at || at - from > 3) return false;
    const std::string before = line.substr(0, from);
    if (before.find_first_not_of("[]=> ") != std::string::npos) return false;
    fraction = std::min(std::stoi(line.substr(from, at - from)), 100) / 100.0;
    words = line.substr(at + 3);
    return true;
}

Job::Job(std::string what, const std::vector<std::string>& words, const std::filesystem::path& program)
    : mWhat(std::move(what)) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw noProcess(errno);
    mPipe = ends[0];
    fcntl(mPipe, F_SETFL, O_NONBLOCK);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    std::vector<char*> arguments{const_cast<char*>("stereonav")}, environment;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    for (char** entry = environ; *entry; ++entry) environment.push_back(*entry);
    environment.push_back(const_cast<char*>(kOften));
    environment.push_back(nullptr);
    pid_t process = 0;
    const WithoutPipeSignal how;
    const int code =
        posix_spawn(&process, program.c_str(), &files, &how.attributes, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&files);
    if (code == 0) putBehindTheWindow(process);
    close(ends[1]);
    if (code != 0) {
        close(mPipe);
        throw noProcess(code);
    }
    mProcess = process;
}

Job::~Job() {
    if (running()) {
        kill(mProcess, SIGTERM);
        while (waitpid(mProcess, &mStatus, 0) < 0 && errno == EINTR) {
        }
    }
    close(mPipe);
}

std::filesystem::path placeOfBake(const std::vector<std::string>& words) {
    Hash hash;
    for (const std::string& word : words) hash.add(word).add(std::string_view("\n"));
    return keptFile(fmt::format("window_{:016x}.light", hash.value()));
}

JobFile::JobFile(std::filesystem::path path) : mPath(std::move(path)), mUnfinished(mPath.c_str()) {}

JobFile::~JobFile() {
    std::error_code code;
    std::filesystem::remove(mPath, code);
}

void Job::cancel() {
    if (!running()) return;
    mCancelled = true;
    kill(mProcess, SIGTERM);
}

void Job::look() {
    if (!running()) return;
    read();
    int status = 0;
    if (waitpid(mProcess, &status, WNOHANG) != mProcess) return;
    read();
    take(std::exchange(mRest, ""));
    mProcess = 0;
    mStatus = status;
    if (status == 0) mFraction = 1;
}

void Job::read() {
    char bytes[4096];
    for (ssize_t count = 0; (count = ::read(mPipe, bytes, sizeof bytes)) > 0;) {
        for (ssize_t n = 0; n < count; ++n) {
            if (bytes[n] == '\n' || bytes[n] == '\r')
                take(std::exchange(mRest, ""));
            else
                mRest += bytes[n];
        }
    }
}

void Job::take(const std::string& line) {
    if (line.empty() || progressOf(line, mFraction, mProgress)) return;
    mLast = line;
}

}  // namespace stereonav
