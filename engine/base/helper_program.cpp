#include "engine/base/helper_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/base/stop.h"

extern char** environ;

namespace stereonav {
namespace fs = std::filesystem;
namespace {

struct Head {
    std::uint64_t bytes = 0;
    HelperAnswer::Kind kind = HelperAnswer::Kind::Given;  // of answers
};
constexpr int kRequests = STDIN_FILENO;  // the helper's end of the socket

Error cannotStart(const fs::path& file, const std::string& purpose, const std::string& reason) {
    return Error(file.string(), "", "can not be started (" + reason + "); it is needed " + purpose,
                 "install the library that is missing, or build the program again");
}

// The process, or the system's error as a negative number. Only `socket` reaches it; what it prints is lost.
int start(const fs::path& file, int socket) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, socket, kRequests);
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

// Whole, or false at the other side's end.
bool readAll(int file, void* to, std::size_t count) {
    for (char* next = static_cast<char*>(to); count > 0;) {
        const ssize_t got = read(file, next, count);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

bool sendAll(int socket, const void* from, std::size_t count) {
    for (const char* next = static_cast<const char*>(from); count > 0;) {
        const ssize_t sent = send(socket, next, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        next += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool sendMessage(int socket, const Head& head, std::string_view bytes) {
    return sendAll(socket, &head, sizeof head) && sendAll(socket, bytes.data(), bytes.size());
}

}  // namespace

HelperProgram::HelperProgram(const fs::path& file, const std::string& purpose, int) {
    int sockets[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
        throw cannotStart(file, purpose, std::strerror(errno));
    mSocket = sockets[0];
    mProcess = start(file, sockets[1]);
    close(sockets[1]);
    if (mProcess > 0) return;
    close(mSocket);
    throw cannotStart(file, purpose, std::strerror(-mProcess));
}

HelperProgram::HelperProgram(const std::string& name, const std::string& purpose)
    : HelperProgram(moduleFolder() / ("stereonav_" + name), purpose, 0) {
    // The first thing that it says is which build it is of.
    const std::string_view build = moduleBuild();
    const fs::path file = moduleFolder() / ("stereonav_" + name);
    Head head;
    if (!receive(&head, sizeof head)) throw cannotStart(file, purpose, "it ended " + waitForEnd());
    std::string said(build.size(), ' ');
    if (head.bytes != said.size() || !receive(said.data(), said.size()) || said != build)
        throw cannotStart(file, purpose, "it is of another build than the program");
}

HelperProgram::~HelperProgram() {
    if (mProcess > 0) kill(mProcess, SIGKILL);
    waitForEnd();
    close(mSocket);
}

bool HelperProgram::send(const void* bytes, std::size_t count) {
    return sendAll(mSocket, bytes, count);
}

bool HelperProgram::receive(void* bytes, std::size_t count) {
    constexpr int kLookEvery_ms = 100;
    for (char* next = static_cast<char*>(bytes); count > 0;) {
        pollfd state{mSocket, POLLIN, 0};
        const int ready = poll(&state, 1, kLookEvery_ms);
        throwIfStopped();
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const ssize_t got = recv(mSocket, next, count, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

std::string HelperProgram::waitForEnd() {
    if (mProcess <= 0) return "";
    int status = 0;
    while (waitpid(mProcess, &status, 0) < 0 && errno == EINTR) {
    }
    mProcess = -1;
    if (WIFSIGNALED(status)) return std::string("by ") + strsignal(WTERMSIG(status));
    return "with status " + std::to_string(WEXITSTATUS(status));
}

HelperAnswer HelperProgram::ask(std::string_view request, std::uint64_t mostBytes) {
    HelperAnswer answer;
    const Head asked{request.size()};
    Head head;
    if (mProcess > 0 && send(&asked, sizeof asked) && send(request.data(), request.size()) &&
        receive(&head, sizeof head) && head.bytes <= mostBytes) {
        answer.text.resize(head.bytes);
        if (receive(answer.text.data(), answer.text.size())) {
            answer.kind = head.kind;
            return answer;
        }
    }
    if (head.bytes > mostBytes && mProcess > 0) kill(mProcess, SIGKILL);  // it is alive
    answer.text = waitForEnd();
    return answer;
}

int serveRequests(const std::function<std::string(std::string_view)>& answer) {
    std::signal(SIGINT, SIG_IGN);  // from a terminal: the program decides
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    if (!sendMessage(kRequests, {std::strlen(moduleBuild())}, moduleBuild())) return 0;
    std::string request;
    for (Head head; readAll(kRequests, &head, sizeof head);) {
        request.resize(head.bytes);
        if (!readAll(kRequests, request.data(), request.size())) return 0;
        HelperAnswer said{HelperAnswer::Kind::Given, ""};
        try {
            said.text = answer(request);
        } catch (const std::exception& error) {
            said = {HelperAnswer::Kind::Refused, error.what()};
        }
        if (!sendMessage(kRequests, {said.text.size(), said.kind}, said.text)) return 0;
    }
    return 0;
}

void limitThisProcess(std::uint64_t memory, int seconds) {
#ifndef __SANITIZE_ADDRESS__
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur =
        std::min<rlim_t>(limit.rlim_max, pages * static_cast<std::uint64_t>(getpagesize()) + memory);
    if (pages > 0) setrlimit(RLIMIT_AS, &limit);
#else
    (void)memory;
#endif
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    rlimit time{};
    getrlimit(RLIMIT_CPU, &time);
    time.rlim_cur = std::min<rlim_t>(
        time.rlim_max, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 + seconds));
    setrlimit(RLIMIT_CPU, &time);
}

}  // namespace stereonav
