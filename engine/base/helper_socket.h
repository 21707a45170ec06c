// The messages between the program and a helper (helper_program.h), on the program's side: each message is a
// head and as many bytes as the head says. The other side is not trusted: a library that a damaged file has
// taken over may say anything, in any pieces, or nothing.
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
        Refused,  // text: what was thrown, one line
        Ended,    // text: how the helper ended over it, "by Segmentation fault"
    };
    Kind kind = Kind::Ended;
    std::string text;
};

// The header of a message.
struct HelperHead {
    std::uint64_t bytes = 0;  // how many follow
    std::uint64_t kind = 0;   // HelperAnswer::Kind of answers, but Ended
};

// The program's end of the connection to a helper.
class HelperSocket {
public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Fate {
        Whole,
        Closed,  // by the other side
        Late,    // it was not whole in time
        Wrong,   // no kind of answer that there is, or a longer one than was allowed
    };

    explicit HelperSocket(int socket);  // takes it over
    ~HelperSocket();
    HelperSocket(const HelperSocket&) = delete;
    HelperSocket& operator=(const HelperSocket&) = delete;

    // Sends a request and takes its answer, of at most mostBytes; `answer` counts where the result is Whole.
    // This, send() and receive() hear a wish to stop (stop.h) within a tenth of a second and throw Cancelled.
    Fate ask(std::string_view request, std::uint64_t mostBytes, Time until, HelperAnswer& answer);
    Fate send(std::string_view bytes, Time until);
    Fate receive(void* to, std::size_t count, Time until);

private:
    bool waitFor(short event, Time until) const;  // false: the time is over

    int mSocket;
};

}  // namespace stereonav
