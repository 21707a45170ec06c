// The six-axis mouse with a daemon that is simulated here: a socket with the messages of spacenavd.
#include "engine/display/space_mouse.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "app/view/input.h"
#include "engine/base/stopwatch.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

using Event = std::array<std::int32_t, 8>;

class PlayedDaemon {
public:
    explicit PlayedDaemon(const std::string& name) : mListens(socket(AF_UNIX, SOCK_STREAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, name.c_str(), sizeof address.sun_path - 1);
        EXPECT_EQ(bind(mListens, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        EXPECT_EQ(listen(mListens, 1), 0);
    }
    ~PlayedDaemon() {
        hangUp();
        close(mListens);
    }
    void answer() { mClient = accept(mListens, nullptr, nullptr); }
    void say(const Event& event) { sayBytes(event, 0, sizeof event); }
    void sayBytes(const Event& event, std::size_t from, std::size_t count) {
        const auto* const bytes = reinterpret_cast<const char*>(event.data());
        EXPECT_EQ(send(mClient, bytes + from, count, MSG_NOSIGNAL), static_cast<ssize_t>(count));
    }
    void hangUp() {
        if (mClient >= 0) close(mClient);
        mClient = -1;
    }

private:
    int mListens, mClient = -1;
};

class SpaceMouseTest : public testing::Test {
protected:
    const TemporaryFolder mFolder;
    const std::string mName = (mFolder / "spnav.sock").string();
};

TEST_F(SpaceMouseTest, WithoutADaemonThereIsNone) {
    for (const std::string& name : {mName, std::string(), std::string(500, 'x')}) {
        SpaceMouse mouse(name);
        for (int n = 0; n < 3; ++n) mouse.look();
        EXPECT_FALSE(mouse.connected());
        EXPECT_FALSE(mouse.state().moved());
        EXPECT_TRUE(mouse.takePresses().empty());
    }
    setenv("SPNAV_SOCKET", "/somewhere/else", 1);
    EXPECT_EQ(SpaceMouse::usualSocket(), "/somewhere/else");
    unsetenv("SPNAV_SOCKET");
    EXPECT_EQ(SpaceMouse::usualSocket(), "/var/run/spnav.sock");
}

TEST_F(SpaceMouseTest, SaysWhatTheDaemonTells) {
    PlayedDaemon daemon(mName);
    SpaceMouse mouse(mName);
    mouse.look();
    ASSERT_TRUE(mouse.connected());
    daemon.answer();
    mouse.look();
    EXPECT_FALSE(mouse.state().moved()) << "nothing was told yet, and nobody waited";
    daemon.say({0, 350, -350, 0, 10, -20, 175, 16});
    mouse.look();
    EXPECT_EQ(mouse.state().push, (std::array{1.0, -1.0, 0.0}));
    EXPECT_EQ(mouse.state().twist[0], 0) << "in the dead zone";
    EXPECT_EQ(mouse.state().twist[1], 0);
    EXPECT_NEAR(mouse.state().twist[2], 0.468, 0.001);
    daemon.say({1, 0, 0, 0, 0, 0, 0, 0});
    daemon.say({2, 0, 0, 0, 0, 0, 0, 0});
    daemon.say({1, 1, 0, 0, 0, 0, 0, 0});
    daemon.say({77, 1, 2, 3, 4, 5, 6, 7});  // from a newer daemon
    mouse.look();
    EXPECT_THAT(mouse.takePresses(), testing::ElementsAre(0, 1));
    EXPECT_TRUE(mouse.takePresses().empty());
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max(),
                           kLeast = std::numeric_limits<std::int32_t>::min();
    const Event extreme{0, kMost, kLeast, 0, 0, 0, 0, 0};
    daemon.sayBytes(extreme, 0, 13);
    mouse.look();
    EXPECT_NEAR(mouse.state().twist[2], 0.468, 0.001) << "half an event is none";
    daemon.sayBytes(extreme, 13, sizeof extreme - 13);
    mouse.look();
    EXPECT_EQ(mouse.state().push, (std::array{1.0, -1.0, 0.0}));
    EXPECT_EQ(mouse.state().twist[2], 0);
}

TEST_F(SpaceMouseTest, ADaemonThatGoesLetsGoAndMayComeBack) {
    constexpr std::chrono::milliseconds kSoon{100};
    PlayedDaemon daemon(mName);
    const Stopwatch watch;
    SpaceMouse mouse(mName, kSoon);
    mouse.look();
    daemon.answer();
    daemon.say({0, 0, 0, 300, 0, 0, 0, 16});
    mouse.look();
    EXPECT_TRUE(mouse.state().moved());
    daemon.hangUp();
    mouse.look();
    EXPECT_FALSE(mouse.connected());
    EXPECT_FALSE(mouse.state().moved());
    EXPECT_TRUE(test::waitFor([&] {
        mouse.look();
        return mouse.connected();
    }));
    EXPECT_GE(watch.elapsed_ms(), static_cast<double>(kSoon.count())) << "not at once again";
}

TEST(SpaceMouseFlight, GoesWhereItIsPushed) {
    SpaceMouseState state;
    const FlightInput rest = withSpaceMouse({}, state);
    EXPECT_EQ(rest.forward, 0);
    EXPECT_EQ(rest.yawRate, 0);
    state.push = {0.5, -0.25, 1};
    FlightInput input = withSpaceMouse({}, state);
    EXPECT_EQ(input.right, 0.5);
    EXPECT_EQ(input.up, -0.25);
    EXPECT_EQ(input.forward, 1);
    input.forward = 0.7;  // with a key held, too
    EXPECT_EQ(withSpaceMouse(input, state).forward, 1);
    EXPECT_EQ(withSpaceMouse(input, state).right, 1);
    // Left-hand rule about right, up and forward: front up is less than 0, to the right is more, right side
    // down is less.
    state = {};
    state.twist = {-1, 0.5, -0.25};
    input = withSpaceMouse({}, state);
    EXPECT_GT(input.pitchRate, 0);
    EXPECT_GT(input.yawRate, 0);
    EXPECT_GT(input.rollRate, 0);
    EXPECT_NEAR(input.yawRate, 0.5 * input.pitchRate, 1e-12);
    EXPECT_EQ(input.forward, 0);
}

TEST(SpaceMouseFlight, ItsButtonsGoHomeAndKeepComfortable) {
    const auto actions = actionsOfSpaceMouse({0, 1, 5, -1});
    ASSERT_EQ(actions.size(), 2u);
    EXPECT_EQ(actions[0].command, ViewCommand::Home);
    EXPECT_EQ(actions[1].command, ViewCommand::KeepComfortable);
}

}  // namespace
}  // namespace stereonav
