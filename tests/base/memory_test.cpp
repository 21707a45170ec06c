// What can be had, read from files as the system has them.
#include "engine/base/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "engine/base/error.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MemoryTest : public testing::Test {
protected:
    void SetUp() override {
        mRoot = fs::temp_directory_path() / ("stereonav-memory-" + std::to_string(getpid()));
        fs::remove_all(mRoot);
        put("proc/meminfo",
            "MemTotal:       24000000 kB\nMemFree:          100 kB\nMemAvailable:   8000000 kB\n");
    }
    void TearDown() override { fs::remove_all(mRoot); }
    void put(const std::string& name, const std::string& content) const {
        fs::create_directories((mRoot / name).parent_path());
        std::ofstream(mRoot / name) << content;
    }
    fs::path mRoot;
};

TEST_F(MemoryTest, IsWhatTheSystemSays) {
    EXPECT_EQ(availableMemory(mRoot), 8000000.0 * 1024);
}

TEST_F(MemoryTest, IsNoMoreThanTheUserWishes) {
    setenv("STEREONAV_MEMORY", "1e9", 1);
    EXPECT_LT(availableMemory(mRoot), 1e9) << "what is taken counts";
    EXPECT_GT(availableMemory(mRoot), 5e8);
    setenv("STEREONAV_MEMORY", "1e12", 1);
    EXPECT_EQ(availableMemory(mRoot), 8000000.0 * 1024);
    for (const char* text : {"", "many", "1e9 bytes", "-1", "nan"}) {
        setenv("STEREONAV_MEMORY", text, 1);
        EXPECT_THROW(availableMemory(mRoot), Error) << text;
    }
    unsetenv("STEREONAV_MEMORY");
}

TEST_F(MemoryTest, IsInfiniteWhereNothingTells) {
    EXPECT_EQ(availableMemory(mRoot / "elsewhere"), std::numeric_limits<double>::infinity());
}

TEST_F(MemoryTest, OfAGroupIsWhatItLeaves) {
    put("proc/self/cgroup", "0::/jobs/one\n");
    const std::string group = "sys/fs/cgroup/jobs/one/";
    put(group + "memory.max", "3000000000\n");
    put(group + "memory.current", "1000000000\n");
    EXPECT_EQ(availableMemory(mRoot), 2e9);
    put(group + "memory.stat", "anon 5\ninactive_file 400000000\nactive_file 7\n");
    EXPECT_EQ(availableMemory(mRoot), 2.4e9) << "files that are kept in memory are given back";
    put(group + "memory.max", "max\n");
    EXPECT_EQ(availableMemory(mRoot), 8000000.0 * 1024);
    put("sys/fs/cgroup/jobs/memory.max", "1500000000\n");  // the one above
    put("sys/fs/cgroup/jobs/memory.current", "500000000\n");
    EXPECT_EQ(availableMemory(mRoot), 1e9);
    put("sys/fs/cgroup/memory.max", "700000000\n");  // what a container sees as its own
    put("sys/fs/cgroup/memory.current", "800000000\n");
    EXPECT_EQ(availableMemory(mRoot), 0);
}

TEST_F(MemoryTest, OfAGroupOfTheFirstVersion) {
    put("proc/self/cgroup", "5:cpu:/x\n4:memory:/box\n0::/\n");
    put("sys/fs/cgroup/memory/box/memory.limit_in_bytes", "2000000000\n");
    put("sys/fs/cgroup/memory/box/memory.usage_in_bytes", "500000000\n");
    EXPECT_EQ(availableMemory(mRoot), 1.5e9);
}

TEST(Memory, ThatIsNotThereIsRefusedWithBothFigures) {
    EXPECT_NO_THROW(checkMemory("--size", 1000, "none"));
    try {
        checkMemory("--size", 1e17, "choose less");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("--size: needs 100000000.0 GB of memory, and "));
        EXPECT_THAT(error.what(), HasSubstr("GB is available; choose less"));
    }
}

}  // namespace
}  // namespace stereonav
