// A mouse with six axes, as the daemon spacenavd tells of it: 32 bytes an event through a Unix socket
// (protocol 0 of spacenavd, which needs no library). Without the daemon there is none; it may come and go.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stereonav {

// State of the axes: shares of a full push or twist, -1 to 1, in the frame of who looks at the screen: right,
// up, forward; and turns about these, by the left-hand rule, as the daemon has them.
struct SpaceMouseState {
    std::array<double, 3> push{}, twist{};
    bool moved() const;
    bool operator==(const SpaceMouseState&) const = default;
};

class SpaceMouse {
public:
    static constexpr std::chrono::milliseconds kLookAgain{2000};
    // Takes a socket: "" never connects. The default is where the daemon's library looks, too.
    explicit SpaceMouse(std::string socket = usualSocket(), std::chrono::milliseconds lookAgain = kLookAgain);
    ~SpaceMouse();
    SpaceMouse(const SpaceMouse&) = delete;
    SpaceMouse& operator=(const SpaceMouse&) = delete;

    // Returns $SPNAV_SOCKET, or /var/run/spnav.sock.
    static std::string usualSocket();

    // Reads what has come, and looks for the daemon now and then while there is none; never waits.
    void look();
    bool connected() const { return mSocket >= 0; }
    const SpaceMouseState& state() const { return mState; }
    std::vector<int> takePresses();  // buttons, counted from 0

private:
    void connect();
    void disconnect();
    void feel(const std::array<std::int32_t, 8>& event);

    std::string mName;
    std::chrono::milliseconds mLookAgain;
    int mSocket = -1;
    std::chrono::steady_clock::time_point mNext{};  // when to look for the daemon again
    std::array<std::byte, 32> mPart{};              // the beginning of an event,
    std::size_t mPartBytes = 0;                     // so many bytes of it
    SpaceMouseState mState;
    std::vector<int> mPresses;
};

}  // namespace stereonav
