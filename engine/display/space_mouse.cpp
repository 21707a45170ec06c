#include "engine/display/space_mouse.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace stereonav {
namespace {

enum Kind : std::int32_t { kMotion = 0, kPress = 1 };  // the first number of an event
constexpr double kFull = 350;                          // value of an axis that is pushed as far as it goes
constexpr double kDeadZone = 0.06;                     // share of kFull
constexpr int kMostEvents = 1000;                      // a look

double withoutDeadZone(std::int32_t value) {
    const double share = std::min(std::abs(static_cast<double>(value)) / kFull, 1.0);
    if (share <= kDeadZone) return 0;
    return std::copysign((share - kDeadZone) / (1 - kDeadZone), static_cast<double>(value));
}

}  // namespace

bool SpaceMouseState::moved() const {
    return *this != SpaceMouseState{};
}

SpaceMouse::SpaceMouse(std::string socket, std::chrono::milliseconds lookAgain)
    : mName(std::move(socket)), mLookAgain(lookAgain) {}

SpaceMouse::~SpaceMouse() {
    disconnect();
}

std::string SpaceMouse::usualSocket() {
    const char* const named = std::getenv("SPNAV_SOCKET");
    return named && *named ? named : "/var/run/spnav.sock";
}

void SpaceMouse::connect() {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (mName.empty() || mName.size() >= sizeof address.sun_path) return;
    std::memcpy(address.sun_path, mName.c_str(), mName.size() + 1);
    const int made = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (made < 0) return;
    // A daemon that has no time now is asked again later.
    if (::connect(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
        mSocket = made;
    else
        close(made);
}

void SpaceMouse::disconnect() {
    if (mSocket >= 0) close(mSocket);
    mSocket = -1;
    mPartBytes = 0;
    mState = {};  // nobody tells that it was let go
}

void SpaceMouse::feel(const std::array<std::int32_t, 8>& event) {
    if (event[0] == kMotion)
        for (std::size_t n = 0; n < 3; ++n) {
            mState.push[n] = withoutDeadZone(event[n + 1]);
            mState.twist[n] = withoutDeadZone(event[n + 4]);
        }
    else if (event[0] == kPress)
        mPresses.push_back(event[1]);
}

void SpaceMouse::look() {
    if (!connected()) {
        const auto now = std::chrono::steady_clock::now();
        if (now < mNext) return;
        mNext = now + mLookAgain;
        connect();
    }
    for (int events = 0; connected() && events < kMostEvents;) {
        const ssize_t got = recv(mSocket, mPart.data() + mPartBytes, mPart.size() - mPartBytes, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
        if (got <= 0) return disconnect();
        mPartBytes += static_cast<std::size_t>(got);
        if (mPartBytes < mPart.size()) continue;
        mPartBytes = 0;
        ++events;
        feel(std::bit_cast<std::array<std::int32_t, 8>>(mPart));
    }
}

std::vector<int> SpaceMouse::takePresses() {
    return std::exchange(mPresses, {});
}

}  // namespace stereonav
