#include "engine/base/helper_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/module.h"
#include "engine/base/sanitizers.h"

extern char** environ;

namespace stereonav {
namespace fs = std::filesystem;
namespace {

std::atomic<std::chrono::milliseconds> longestWait = std::chrono::milliseconds::max();

Error cannotStart(const fs::path& file, const std::string& purpose, const std::string& reason) {
    return Error(file.string(), "", "can not be started (" + reason + "); it is needed " + purpose,
                 "install the library that is missing, or build the program again");
}

// Starts the program. Returns the process, or the system's error as a negative number. `socket` is its only
// connection; what it prints is lost.
int start(const fs::path& file, int socket) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    std::string name = file.string();
    char* const arguments[] = {name.data(), nullptr};
    pid_t process = -1;
    const int error = posix_spawn(&process, file.c_str(), &files, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    return error ? -error : process;
}

// No more than there is, where it is much.
std::uint64_t memoryWithin(std::uint64_t most) {
    constexpr std::uint64_t kWorthAsking = std::uint64_t{1} << 29;
    if (most <= kWorthAsking) return most;
    const double there = std::max(availableMemory(), static_cast<double>(kWorthAsking));
    return there < static_cast<double>(most) ? static_cast<std::uint64_t>(there) : most;
}

void limitSoftly(pid_t process, __rlimit_resource what, rlim_t most) {
    rlimit limit{};
    if (prlimit(process, what, nullptr, &limit) != 0) return;
    limit.rlim_cur = std::min(limit.rlim_max, most);
    prlimit(process, what, &limit, nullptr);
}

std::string howItEnded(int status) {
    if (WIFSIGNALED(status)) return std::string("by ") + strsignal(WTERMSIG(status));
    return "with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

HelperLimits limitsForPicture(std::uint64_t pixels, std::uint64_t packed, std::uint64_t answer) {
    constexpr std::uint64_t kBytesPerPixel = 64, kCopies = 8, kAlways = std::uint64_t{256} << 20;
    constexpr std::chrono::seconds kWork(20);
    constexpr std::uint64_t kPixelsPerSecond = 250'000;  // a tenth of what slow codecs do on slow machines
    constexpr std::chrono::minutes kMore(1);
    constexpr int kShare = 4;  // helpers that may share a processor
    HelperLimits limits;
    limits.answer = answer;
    limits.memory = kAlways + kBytesPerPixel * pixels + kCopies * packed;
    limits.work = kWork + std::chrono::seconds(pixels / kPixelsPerSecond);
    limits.wait = kMore + kShare * limits.work;
    return limits;
}

void waitForHelpersAtMost(std::chrono::milliseconds longest) {
    longestWait = longest;
}

HelperProgram::HelperProgram(const fs::path& file, const std::string& purpose, int) {
    int sockets[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
        throw cannotStart(file, purpose, std::strerror(errno));
    mSocket.emplace(sockets[0]);
    mProcess = start(file, sockets[1]);
    close(sockets[1]);
    if (mProcess < 0) throw cannotStart(file, purpose, std::strerror(-mProcess));
}

HelperProgram::HelperProgram(const std::string& name, const std::string& purpose,
                             std::chrono::milliseconds startWithin)
    : HelperProgram(moduleFolder() / ("stereonav_" + name), purpose, 0) {
    // The first thing that it says is which build it is of.
    using Fate = HelperSocket::Fate;
    const std::string_view build = moduleBuild();
    const fs::path file = moduleFolder() / ("stereonav_" + name);
    const auto until = HelperSocket::Time::clock::now() + startWithin;
    HelperHead head;
    std::string said(build.size(), ' ');
    Fate fate = mSocket->receive(&head, sizeof head, until);
    if (fate == Fate::Closed) throw cannotStart(file, purpose, "it ended " + waitForEnd());
    if (fate == Fate::Whole) fate = head.bytes == said.size() ? fate : Fate::Wrong;
    if (fate == Fate::Whole) fate = mSocket->receive(said.data(), said.size(), until);
    if (fate == Fate::Late)
        throw cannotStart(file, purpose, fmt::format("no word from it in {} s", startWithin.count() / 1e3));
    if (fate != Fate::Whole || said != build)
        throw cannotStart(file, purpose, "it is of another build than the program");
}

HelperProgram::~HelperProgram() {
    end();
}

std::string HelperProgram::end() {
    if (mProcess > 0) kill(mProcess, SIGKILL);
    return waitForEnd(0);
}

// Waits for a helper that has closed its end of the pipe, and so is about to exit; kills it where it has not
// after `looks` looks.
std::string HelperProgram::waitForEnd(int looks) {
    constexpr std::chrono::milliseconds kLookEvery(10);
    int status = 0;
    for (int look = 0; mProcess > 0; ++look) {
        if (look == looks) kill(mProcess, SIGKILL);
        const pid_t ended = waitpid(mProcess, &status, look < looks ? WNOHANG : 0);
        if (ended == mProcess || (ended < 0 && errno != EINTR)) break;
        if (look < looks) std::this_thread::sleep_for(kLookEvery);
    }
    mProcess = -1;
    return howItEnded(status);
}

// Sets the limits from this process, so that a helper need not be allowed to change its own.
void HelperProgram::limit(const HelperLimits& limits) const {
    if (!kAddressSanitizer) {
        std::uint64_t pages = 0;
        std::ifstream(fmt::format("/proc/{}/statm", mProcess)) >> pages;
        const std::uint64_t taken = pages * static_cast<std::uint64_t>(getpagesize());
        if (pages > 0) limitSoftly(mProcess, RLIMIT_AS, taken + memoryWithin(limits.memory));
    }
    clockid_t clock = 0;
    timespec used{};
    if (clock_getcpuclockid(mProcess, &clock) == 0 && clock_gettime(clock, &used) == 0)
        limitSoftly(mProcess, RLIMIT_CPU, static_cast<rlim_t>(used.tv_sec + 1 + limits.work.count()));
}

HelperAnswer HelperProgram::ask(std::string_view request, const HelperLimits& limits) {
    using Fate = HelperSocket::Fate;
    HelperAnswer answer;
    if (mProcess <= 0) return answer;
    limit(limits);
    const std::chrono::milliseconds wait = std::min(limits.wait, longestWait.load());
    switch (mSocket->ask(request, limits.answer, HelperSocket::Time::clock::now() + wait, answer)) {
        case Fate::Whole:
            return answer;
        case Fate::Closed:
            answer.text = waitForEnd();
            break;
        case Fate::Late:
            end();
            answer.text = fmt::format("by the program, after {} s without an answer", wait.count() / 1e3);
            break;
        case Fate::Wrong:
            end();
            answer.text = "by the program, because its answer is malformed";
            break;
    }
    answer.kind = HelperAnswer::Kind::Ended;
    return answer;
}

}  // namespace stereonav
