// .ci/skipped tells of every test that did not run, in the words of GoogleTest 1.12.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace stereonav {
namespace {

struct Said {
    int status = -1;
    std::string text;
};

// Returns what the script says of a file with this content.
Said skippedIn(const std::string& content) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("stereonav-skipped-" + std::to_string(getpid()));
    std::ofstream(file) << content;
    Said said;
    std::FILE* pipe =
        popen(("'" STEREONAV_SOURCE_DIR "/.ci/skipped' '" + file.string() + "' 2>&1").c_str(), "r");
    for (int c = 0; pipe && (c = std::fgetc(pipe)) != EOF;) said.text += static_cast<char>(c);
    if (pipe) said.status = WEXITSTATUS(pclose(pipe));
    std::filesystem::remove(file);
    return said;
}

const std::string kPassed =
    "1/2 Testing: A\nOutput:\n[ RUN      ] A.Runs\n[       OK ] A.Runs (12 ms)\n[  PASSED  ] 1 test.\n<end "
    "of output>\n";

TEST(SkippedScript, CountsWhatGoogleTestPrints) {
    const Said said = skippedIn(
        kPassed +
        "2/2 Testing: B\n[ RUN      ] B.Skips/1\nt.cpp:3: Skipped\nno data & no tool\n\n"
        "[  SKIPPED ] B.Skips/1 (0 ms)\n[ RUN      ] B.Fails\nt.cpp:9: Failure\n[  FAILED  ] B.Fails (1 ms)\n"
        "[  SKIPPED ] 1 test, listed below:\n[  SKIPPED ] B.Skips/1\n[  FAILED  ] 1 test, listed below:\n"
        "[  FAILED  ] B.Fails\n");
    EXPECT_EQ(said.status, 0);
    EXPECT_EQ(said.text, "1 passed, 1 failed, 1 skipped\n    B.Skips/1: no data & no tool\n");
}

TEST(SkippedScript, SaysThatNoneWas) {
    EXPECT_EQ(skippedIn(kPassed).text, "1 passed, 0 failed, 0 skipped\n");
}

TEST(SkippedScript, RefusesWhatIsNoRun) {
    for (const char* content : {"", "a diary\n"}) {
        const Said said = skippedIn(content);
        EXPECT_EQ(said.status, 2);
        EXPECT_NE(said.text.find("holds no run of GoogleTest"), std::string::npos) << said.text;
    }
}

}  // namespace
}  // namespace stereonav
