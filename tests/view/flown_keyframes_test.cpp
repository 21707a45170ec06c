// Keyframes on the map and the flight that follows them.
#include "app/view/flown_keyframes.h"

#include <gtest/gtest.h>

#include "app/view/notices.h"
#include "tests/view/session_fixture.h"

namespace stereonav {
namespace {

class FollowedKeyframes : public SessionFixture {
protected:
    static Keyframes two() {
        return timedKeyframes({poseFromAngles({0, 0, 500}, 0, 0, 0), poseFromAngles({0, 800, 500}, 0, 0, 0)},
                              100);
    }

    FlownKeyframes mKeyframes;
    Notices mNotices{ViewOptions{}};
};

TEST_F(FollowedKeyframes, TheFlightGoesThroughThem) {
    ViewSession session = this->session();
    mKeyframes.edit().start(two());
    mKeyframes.follow(session, mNotices);
    ASSERT_GT(session.paths().path().samples().size(), 1u);
    EXPECT_NEAR(session.paths().path().samples().back().pose.position.y, 800, 1);
    EXPECT_TRUE(mKeyframes.edit().any());
}

TEST_F(FollowedKeyframes, NotWhileOneIsDragged) {
    ViewSession session = this->session();
    mKeyframes.edit().start(two());
    mKeyframes.follow(session, mNotices);
    const long long version = session.paths().version();
    mKeyframes.edit().beginDrag(1);
    mKeyframes.edit().dragTo({0, 400, 500});
    mKeyframes.follow(session, mNotices);
    EXPECT_EQ(session.paths().version(), version);
    mKeyframes.edit().endDrag();
    mKeyframes.follow(session, mNotices);
    EXPECT_NEAR(session.paths().path().samples().back().pose.position.y, 400, 1);
}

TEST_F(FollowedKeyframes, AnotherPathEndsThem) {
    ViewSession session = this->session();
    mKeyframes.edit().start(two());
    mKeyframes.follow(session, mNotices);
    session.paths().open(flatScene().path);
    mKeyframes.follow(session, mNotices);
    EXPECT_FALSE(mKeyframes.edit().any());
}

}  // namespace
}  // namespace stereonav
