// .ci/skipped tells of every test that did not run, from both of ctest's forms, in the words of ctest 3.25.
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

// What the script says of a file with this content.
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
    "12/12 Test #12: B.Runs ....   Passed    0.00 sec\n\n100% tests passed, 0 tests failed out of 12\n";

TEST(SkippedScript, ReadsWhatCtestPrints) {
    const Said said = skippedIn("== tests\n" + kPassed +
                                "\nTotal Test time (real) =   0.03 sec\n\nThe following tests did not run:\n"
                                "\t  2 - A.Skips (Skipped)\n\t 11 - W/P.Q/1 (Disabled)\n\nci: over\n");
    EXPECT_EQ(said.status, 0);
    EXPECT_EQ(said.text, "2 tests skipped:\n    A.Skips\n    W/P.Q/1\n");
}

TEST(SkippedScript, SaysThatNoneWas) {
    EXPECT_EQ(skippedIn(kPassed).text, "0 tests skipped\n");
}

TEST(SkippedScript, ReadsTheReasonsFromJUnit) {
    const Said said = skippedIn(
        "<?xml version=\"1.0\"?>\n<testsuite name=\"(empty)\"\n\ttests=\"3\"\n\t>\n"
        "\t<testcase name=\"A.Runs\" classname=\"A.Runs\" time=\"0.002\" status=\"run\">\n"
        "\t\t<system-out>all well\n</system-out>\n\t</testcase>\n"
        "\t<testcase name=\"A.&lt;Skips&gt;\" classname=\"A.Skips\" time=\"0.02\" status=\"notrun\">\n"
        "\t\t<skipped message=\"SKIP_REGULAR_EXPRESSION_MATCHED\"/>\n"
        "\t\t<system-out>[ RUN      ] A.Skips\nt.cpp:3: Skipped\nno data &amp; no "
        "tool\n</system-out>\n\t</testcase>\n"
        "</testsuite>\n");
    EXPECT_EQ(said.status, 0);
    EXPECT_EQ(said.text, "1 test skipped:\n    A.<Skips>: no data & no tool\n");
}

TEST(SkippedScript, RefusesWhatIsNoRun) {
    for (const char* content : {"", "a diary\n"}) {
        const Said said = skippedIn(content);
        EXPECT_EQ(said.status, 2);
        EXPECT_NE(said.text.find("holds no run of ctest"), std::string::npos) << said.text;
    }
}

}  // namespace
}  // namespace stereonav
