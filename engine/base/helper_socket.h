// The messages between the program and a helper (helper_program.h), on the program's side: each message is a
// head and as many bytes as the head says. The other side is not trusted: a library that a damaged file has
// taken over may send anything, in any pieces, or nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stereonav {

struct HelperAnswer {
    enum class Kind {
        Given,    // text: the answer's bytes
        Refused,  // text: message of the exception, one line
        Ended,    // text: how the helper ended during the request, "by Segmentation fault"
    };
    Kind kind = Kind::Ended;
    std::string text;
};

// The header of a message.
struct HelperHead {
    std::uint64_t bytes = 0;  // number of bytes that follow
    std::uint64_t kind = 0;   // HelperAnswer::Kind for answers, except Ended
};

// The program's end of the connection to a helper.
class HelperSocket {
public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Fate {
        Whole,
        Closed,  // by the other side
        Late,    // the answer was not complete in time
        Wrong,   // no valid kind of answer, or an answer longer than allowed
    };

    explicit HelperSocket(int socket);  // takes ownership of the socket
    ~HelperSocket();
    HelperSocket(const HelperSocket&) = delete;
    HelperSocket& operator=(const HelperSocket&) = delete;

    // Sends a request and receives its answer, of at most mostBytes bytes; `answer` is valid where the result
    // is Whole. ask(), send() and receive() notice a wish to stop (stop.h) within a tenth of a second and
    // throw Cancelled.
    Fate ask(std::string_view request, std::uint64_t mostBytes, Time until, HelperAnswer& answer);
    Fate send(std::string_view bytes, Time until);
    Fate receive(void* to, std::size_t count, Time until);

private:
    bool waitFor(short event, Time until) const;  // returns false after the time limit

    int mSocket;
};

}  // namespace stereonav
