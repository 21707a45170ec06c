// A mouse with six axes, from the daemon spacenavd: 32 bytes per event through a Unix socket (protocol 0 of
// spacenavd, which needs no library). Without the daemon there is no mouse; it may start and stop at any
// time.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stereonav {

// State of the axes: shares of a full push or twist, -1 to 1, seen by the user before the screen: right, up,
// forward; and turns about these axes by the left-hand rule, as the daemon gives them.
struct SpaceMouseState {
    std::array<double, 3> push{}, twist{};
    bool moved() const;
    bool operator==(const SpaceMouseState&) const = default;
};

class SpaceMouse {
public:
    static constexpr std::chrono::milliseconds kLookAgain{2000};
    // socket: path of the daemon's socket; "" never connects. The default is where the daemon's own library
    // looks as well.
    explicit SpaceMouse(std::string socket = usualSocket(), std::chrono::milliseconds lookAgain = kLookAgain);
    ~SpaceMouse();
    SpaceMouse(const SpaceMouse&) = delete;
    SpaceMouse& operator=(const SpaceMouse&) = delete;

    // Returns $SPNAV_SOCKET, or /var/run/spnav.sock.
    static std::string usualSocket();

    // Reads events that have come; while there is no daemon, looks for it now and then. Never waits.
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
    std::array<std::byte, 32> mPart{};              // the beginning of an incomplete event
    std::size_t mPartBytes = 0;                     // number of its bytes
    SpaceMouseState mState;
    std::vector<int> mPresses;
};

}  // namespace stereonav
