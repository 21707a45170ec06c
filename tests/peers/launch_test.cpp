// What launchers put into the environment, and how cores are shared.
#include "engine/peers/launch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "engine/peers/core_share.h"

namespace stereonav {
namespace {

using Variables = std::map<std::string, std::string>;

Launch launchWith(const Variables& variables) {
    return launchOf([&](const char* name) -> const char* {
        const auto at = variables.find(name);
        return at == variables.end() ? nullptr : at->second.c_str();
    });
}

TEST(Launch, IsOfSeveralWhereTheLauncherSaysSo) {
    const Launch open =
        launchWith({{"OMPI_COMM_WORLD_SIZE", "3"}, {"OMPI_COMM_WORLD_RANK", "2"}, {"PMIX_RANK", "2"}});
    EXPECT_TRUE(open.several);
    EXPECT_EQ(open.rank, 2);
    EXPECT_EQ(open.count, 3);
    const Launch pmi = launchWith({{"PMI_SIZE", "16"}, {"PMI_RANK", "15"}, {"SLURM_NTASKS", "16"}});
    EXPECT_TRUE(pmi.several);
    EXPECT_EQ(pmi.rank, 15);
    const Launch pmix = launchWith({{"PMIX_RANK", "1"}, {"SLURM_STEP_NUM_TASKS", "4"}});
    EXPECT_TRUE(pmix.several);
    EXPECT_EQ(pmix.count, 4);
    const Launch unknown = launchWith({{"PMIX_RANK", "1"}});
    EXPECT_TRUE(unknown.several);
    EXPECT_EQ(unknown.count, 0);
}

TEST(Launch, IsOfOneOtherwise) {
    const std::vector<Variables> ones{{},
                                      {{"OMPI_COMM_WORLD_SIZE", "1"}, {"OMPI_COMM_WORLD_RANK", "0"}},
                                      {{"PMI_SIZE", "1"}},
                                      {{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "1"}},
                                      // a batch script, and a task of a job array
                                      {{"SLURM_NTASKS", "64"}, {"SLURM_PROCID", "0"}},
                                      {{"SLURM_ARRAY_TASK_ID", "7"}, {"SLURM_NTASKS", "1"}},
                                      // no numbers
                                      {{"OMPI_COMM_WORLD_SIZE", ""}},
                                      {{"PMI_SIZE", "2x"}},
                                      {{"PMI_SIZE", "-2"}},
                                      {{"OMPI_COMM_WORLD_SIZE", "99999999999999"}}};
    for (const Variables& one : ones) {
        EXPECT_FALSE(launchWith(one).several) << (one.empty() ? "" : one.begin()->first);
        EXPECT_EQ(launchWith(one).rank, 0);
    }
}

ProcessPlace placed(const std::string& machine, std::uint64_t low, std::uint64_t high = 0) {
    ProcessPlace place;
    place.machine = machine;
    place.cores.front() = low;
    place.cores.back() = high;
    return place;
}

TEST(CoreShares, AreEvenAmongThoseWhoMayRunOnTheSameCores) {
    EXPECT_THAT(coreShares({placed("a", 0xff), placed("a", 0xff), placed("b", 0xff)}),
                testing::ElementsAre(4, 4, 8));
    // Each bound to cores of its own, the last ones of a large machine among them.
    EXPECT_THAT(coreShares({placed("a", 0xf), placed("a", 0xf0), placed("a", 0, 0x3)}),
                testing::ElementsAre(4, 4, 2));
    // More processes than cores, and none that is known.
    EXPECT_THAT(coreShares({placed("a", 3), placed("a", 3), placed("a", 3)}), testing::ElementsAre(1, 1, 1));
    EXPECT_THAT(coreShares({placed("a", 0)}), testing::ElementsAre(1));
    EXPECT_THAT(coreShares({}), testing::IsEmpty());
}

TEST(CoreShares, KnowThisProcess) {
    const ProcessPlace here = placeOfThisProcess();
    EXPECT_FALSE(here.machine.empty());
    EXPECT_GE(coreShares({here}).front(), 1);
}

}  // namespace
}  // namespace stereonav
