// The quality dial as a user turns it.
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Quality = ProgramTest;

std::vector<std::string> small(std::vector<std::string> more) {
    std::vector<std::string> all{"play", "--size", "160x120", "--frames", "2", "--hash"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

TEST_F(Quality, WhatCanNotBeIsRefused) {
    expectRefused(small({"--quality", "1.5"}), {"--quality", "expected 0 to 1, got \"1.5\""});
    expectRefused(small({"--quality", "nan"}), {"--quality", "expected 0 to 1"});
    expectRefused(small({"--target-psnr", "0"}), {"--target-psnr", "expected 1 to 100 dB, got \"0\""});
    expectRefused(small({"--target-ms", "-3"}), {"--target-ms", "got \"-3\""});
    expectRefused(small({"--quality", "0.5", "--method", "paper"}), {"--quality", "paper"});
    expectRefused(small({"cloud", "--quality", "0.5"}), {"--quality", "medium"});
}

TEST_F(Quality, MoreIsCastAndItIsTheSameEachTime) {
    const auto hash = [&](std::vector<std::string> more) {
        const Outcome outcome = run(small(std::move(more)));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find("hash"));
    };
    const std::string plain = hash({}), half = hash({"--quality", "0.5"});
    EXPECT_NE(half, plain);
    EXPECT_EQ(hash({"--quality", "0.5"}), half);
    EXPECT_EQ(hash({"--quality", "0"}), plain);
    EXPECT_EQ(hash({"--quality", "1"}), hash({"--method", "full"}));
}

TEST_F(Quality, SaysWhatIsToBeExpected) {
    const std::string out = (place() / "a.png").string();
    const Outcome outcome = run({"render", "--size", "200x160", "--target-psnr", "50", "--out", out});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::size_t at = outcome.out.find("frames reach ");
    ASSERT_NE(at, std::string::npos) << outcome.out;
    EXPECT_GE(std::stod(outcome.out.substr(at + 13)), 50.0);
}

}  // namespace
}  // namespace stereonav::test
