// What a helper can not do, whoever has taken it over.
#include <gtest/gtest.h>

#include <string>

#include "engine/base/helper_program.h"
#include "engine/base/sanitizers.h"

namespace stereonav {
namespace {

constexpr const char* kWaysOut[] = {"open", "create", "stat", "remove", "socket", "unix",
                                    "fork", "exec",   "kill", "trace",  "limits", "limits of its owner",
                                    "code"};

TEST(HelperSandbox, HasNoWayOut) {
    if (kAddressSanitizer || kThreadSanitizer)
        GTEST_SKIP() << "sanitizers open files and map memory as they like";
    HelperProgram helper("test_helper", "by this test");
    for (const std::string way : kWaysOut) {
        const HelperAnswer answer = helper.ask("try " + way, {1000});
        EXPECT_EQ(answer.kind, HelperAnswer::Kind::Given) << way << ": " << answer.text;
        EXPECT_EQ(answer.text, "Operation not permitted") << way;
    }
    EXPECT_EQ(helper.ask("echo a", {1000}).text, "a") << "it goes on";
}

}  // namespace
}  // namespace stereonav
