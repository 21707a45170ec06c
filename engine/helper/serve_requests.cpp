#include "engine/helper/serve_requests.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "engine/base/helper_socket.h"
#include "engine/base/module.h"
#include "engine/helper/sandbox.h"

namespace stereonav {
namespace {

constexpr int kRequests = STDIN_FILENO;  // the helper's end of the socket
constexpr int kNoSandbox = 70;           // main's status

// Reads all that is asked for. Returns false at the other side's end.
bool readAll(void* to, std::size_t count) {
    for (char* next = static_cast<char*>(to); count > 0;) {
        const ssize_t got = read(kRequests, next, count);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

bool sendAll(const void* from, std::size_t count) {
    for (const char* next = static_cast<const char*>(from); count > 0;) {
        const ssize_t sent = send(kRequests, next, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        next += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool sendMessage(HelperAnswer::Kind kind, std::string_view bytes) {
    const HelperHead head{bytes.size(), static_cast<std::uint64_t>(kind)};
    return sendAll(&head, sizeof head) && sendAll(bytes.data(), bytes.size());
}

}  // namespace

int serveRequests(const std::function<std::string(std::string_view)>& answer) {
    using Kind = HelperAnswer::Kind;
    std::signal(SIGINT, SIG_IGN);  // from a terminal: the program decides
    if (!enterSandbox()) return kNoSandbox;
    if (!sendMessage(Kind::Given, moduleBuild())) return 0;
    std::string request;
    for (HelperHead head; readAll(&head, sizeof head);) {
        request.resize(head.bytes);
        if (!readAll(request.data(), request.size())) return 0;
        HelperAnswer said{Kind::Given, ""};
        try {
            said.text = answer(request);
        } catch (const std::exception& error) {
            said = {Kind::Refused, error.what()};
        }
        if (!sendMessage(said.kind, said.text)) return 0;
    }
    return 0;
}

}  // namespace stereonav
