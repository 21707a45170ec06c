// A helper for helper_program_test.cpp, helper_pool_test.cpp and helper_sandbox_test.cpp: does as it is told.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/helper/serve_requests.h"

namespace {

// Returns what each way out of the process gives: 0 or more where it is open.
long tryWay(const std::string& way) {
    static char program[] = "/bin/true", *arguments[] = {program, nullptr};
    struct stat status {};
    rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
    if (way == "open") return open("/etc/passwd", O_RDONLY | O_CLOEXEC);
    if (way == "create") return open("/tmp", O_RDWR | O_TMPFILE | O_CLOEXEC, 0600);
    if (way == "stat") return stat("/etc/passwd", &status);
    if (way == "remove") return unlink("/tmp/stereonav-there-is-no-such-file");
    if (way == "socket") return socket(AF_INET, SOCK_STREAM, 0);
    if (way == "unix") return socket(AF_UNIX, SOCK_STREAM, 0);
    if (way == "fork") return fork();
    if (way == "exec") return execv(program, arguments);
    if (way == "kill") return kill(getppid(), 0);
    if (way == "trace") return ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    if (way == "limits") return prlimit(0, RLIMIT_AS, &limit, nullptr);
    if (way == "limits of its owner") return prlimit(getppid(), RLIMIT_AS, nullptr, &limit);
    if (way == "code") {
        void* const page = mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        return page == MAP_FAILED ? -1 : 0;
    }
    throw std::runtime_error("unknown way");
}

std::string obey(std::string_view request) {
    constexpr std::uint64_t kMegabyte = 1 << 20;
    const std::string word(request.substr(0, request.find(' ')));
    const std::string rest(request.substr(std::min(request.size(), word.size() + 1)));
    if (word == "echo") return rest;
    if (word == "who") return std::to_string(getpid());
    if (word == "throw") throw std::runtime_error(rest.empty() ? "expected a sound request" : rest);
    if (word == "crash") std::raise(SIGSEGV);
    if (word == "leave") _exit(7);
    if (word == "close") close(STDIN_FILENO);
    if (word == "sleep" || word == "close")
        for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    if (word == "try") {
        const long result = tryWay(rest);
        return result < 0 ? std::strerror(errno) : "it could";
    }
    if (word == "print") {
        const std::string text = "to both streams\n";
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
            if (write(stream, text.data(), text.size()) < 0) return "could not";
        return "printed";
    }
    if (word == "spin")
        for (std::atomic<int> n = 0;;) ++n;
    if (word == "take") {
        try {
            const std::vector<char> much(512 * kMegabyte, 1);
            return "taken";
        } catch (const std::bad_alloc&) {
            return "refused";
        }
    }
    return "unknown word";
}

}  // namespace

int main() {
    return stereonav::serveRequests(obey);
}
