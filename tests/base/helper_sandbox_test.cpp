// What a helper can not do, whoever has taken it over.
#include <gtest/gtest.h>

#include "engine/base/helper_program.h"
#include "engine/base/sanitizers.h"

namespace stereonav {
namespace {

class HelperSandbox : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (kAddressSanitizer || kThreadSanitizer)
            GTEST_SKIP() << "sanitizers open files and map memory as they like";
    }
};

TEST_P(HelperSandbox, HasNoSuchWayOut) {
    HelperProgram helper("test_helper", "by this test");
    const HelperAnswer answer = helper.ask(std::string("try ") + GetParam(), {1000});
    EXPECT_EQ(answer.kind, HelperAnswer::Kind::Given) << answer.text;
    EXPECT_EQ(answer.text, "Operation not permitted");
    EXPECT_EQ(helper.ask("echo a", {1000}).text, "a") << "it goes on";
}

std::string nameOfWay(const testing::TestParamInfo<const char*>& way) {
    std::string name = way.param;
    for (char& c : name) c = c == ' ' ? '_' : c;
    return name;
}

INSTANTIATE_TEST_SUITE_P(Ways, HelperSandbox,
                         testing::Values("open", "create", "stat", "remove", "socket", "unix", "fork", "exec",
                                         "kill", "trace", "limits", "limits of its owner", "code"),
                         nameOfWay);

}  // namespace
}  // namespace stereonav
