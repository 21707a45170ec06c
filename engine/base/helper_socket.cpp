#include "engine/base/helper_socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "engine/base/stop.h"

namespace stereonav {
namespace {

constexpr std::uint64_t kLongestRefusal = 2000;  // bytes

bool tryAgain() {
    return errno == EAGAIN || errno == EWOULDBLOCK;
}

// One line of letters, whatever was said.
std::string lineOf(std::string text) {
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return text;
}

}  // namespace

HelperSocket::HelperSocket(int socket) : mSocket(socket) {}

HelperSocket::~HelperSocket() {
    close(mSocket);
}

bool HelperSocket::waitFor(short event, Time until) const {
    constexpr std::chrono::milliseconds kLookEvery(100);
    for (;;) {
        throwIfStopped();
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Time::clock::now());
        if (left.count() <= 0) return false;
        pollfd state{mSocket, event, 0};
        const int ready = poll(&state, 1, static_cast<int>(std::min(left, kLookEvery).count()));
        if (ready > 0 || (ready < 0 && errno != EINTR)) return true;  // what is wrong, reading it tells
    }
}

HelperSocket::Fate HelperSocket::send(std::string_view bytes, Time until) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(mSocket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0)
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        else if (sent < 0 && tryAgain()) {
            if (!waitFor(POLLOUT, until)) return Fate::Late;
        } else if (sent == 0 || errno != EINTR)
            return Fate::Closed;
    }
    return Fate::Whole;
}

HelperSocket::Fate HelperSocket::receive(void* bytes, std::size_t count, Time until) {
    for (char* next = static_cast<char*>(bytes); count > 0;) {
        const ssize_t got = recv(mSocket, next, count, MSG_DONTWAIT);
        if (got > 0) {
            next += got;
            count -= static_cast<std::size_t>(got);
        } else if (got < 0 && tryAgain()) {
            if (!waitFor(POLLIN, until)) return Fate::Late;
        } else if (got == 0 || errno != EINTR)
            return Fate::Closed;
    }
    return Fate::Whole;
}

HelperSocket::Fate HelperSocket::ask(std::string_view request, std::uint64_t mostBytes, Time until,
                                     HelperAnswer& answer) {
    using Kind = HelperAnswer::Kind;
    HelperHead head{request.size()};
    Fate fate = send({reinterpret_cast<const char*>(&head), sizeof head}, until);
    if (fate == Fate::Whole) fate = send(request, until);
    if (fate == Fate::Whole) fate = receive(&head, sizeof head, until);
    if (fate != Fate::Whole) return fate;
    const bool given = head.kind == static_cast<std::uint64_t>(Kind::Given);
    if (!given && head.kind != static_cast<std::uint64_t>(Kind::Refused)) return Fate::Wrong;
    if (head.bytes > (given ? mostBytes : kLongestRefusal)) return Fate::Wrong;
    answer.text.resize(head.bytes);
    fate = receive(answer.text.data(), answer.text.size(), until);
    if (!given) answer.text = lineOf(std::move(answer.text));
    answer.kind = given ? Kind::Given : Kind::Refused;
    return fate;
}

}  // namespace stereonav
