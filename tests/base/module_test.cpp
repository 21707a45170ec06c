// Modules: what crosses their border, and what is said where one is missing or wrong.
#include "engine/base/module.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/base/module/functions.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const TestModuleFunctions& module() {
    return moduleFunctions<TestModuleFunctions>("test", "by this test");
}

std::string moduleMessageOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

std::string failureOf(const std::string& name) {
    return moduleMessageOf([&] { moduleFunctions<TestModuleFunctions>(name, "by this test"); });
}

TEST(Module, IsLoadedWhenItsFunctionsAreAskedForAndStays) {
    const auto file = EndsWith("stereonav_test.so");
    const auto before = loadedLibraries();
    const TestModuleFunctions& first = module();
    EXPECT_THAT(loadedLibraries(), Contains(file));
    if (testing::UnitTest::GetInstance()->test_to_run_count() == 1) {  // ctest runs each test alone
        EXPECT_THAT(before, Not(Contains(file)));
    }
    EXPECT_EQ(&module(), &first);
}

// Without /proc the program's file is the one that was started, by whatever name.
TEST(Module, TheProgramsFileIsKnownWithoutProc) {
    const std::filesystem::path expected = std::filesystem::canonical("/proc/self/exe");
    EXPECT_EQ(programFile(), expected);
    EXPECT_EQ(programFile("/nowhere"), expected);
}

TEST(Module, ErrorsPassTheBorder) {
    EXPECT_EQ(moduleMessageOf([] { module().throwError("a.txt"); }),
              "a.txt:line 3: expected a number; write one");
    EXPECT_EQ(moduleMessageOf([] { module().throwFromLoop(); }), "40 is one too many");
}

TEST(Module, CancellingPassesTheBorderAsItself) {
    Progress progress;
    EXPECT_THROW(module().throwCancelled(progress), Cancelled);
    EXPECT_TRUE(progress.cancelled());
}

TEST(Module, LoopsRunOnTheProgramsThreads) {
    module();  // loaded before the count is set
    for (const int threads : {3, 1, 2}) {
        setThreadCount(threads);
        EXPECT_EQ(module().threads(), threads);
    }
}

TEST(Module, ObjectsMadeInItAreUsedAndDestroyedOutside) {
    const std::unique_ptr<Sum> sum = module().makeSum();
    sum->add({1, 2, 3});
    sum->add(std::vector<int>(1000, 7));
    EXPECT_EQ(sum->value(), 7006);
}

TEST(Module, AMissingOneIsNamedWithWhatToDo) {
    EXPECT_THAT(
        failureOf("nothing"),
        AllOf(HasSubstr((moduleFolder() / "stereonav_nothing.so").string() + ": there is no such module"),
              HasSubstr("it is needed by this test"), HasSubstr("build the target stereonav_nothing"),
              Not(HasSubstr("\n"))));
}

TEST(Module, OneOfAnotherBuildIsRefused) {
    EXPECT_THAT(failureOf("test_other_build"), HasSubstr("it is of another build than the program"));
    EXPECT_THAT(moduleMessageOf([] { moduleFunctions<int>("test", "by this test"); }),
                HasSubstr("it is of another build than the program"));
}

TEST(Module, OtherFilesAreRefused) {
    EXPECT_THAT(failureOf("test_no_entry"), HasSubstr("it is no module of this program"));
    const auto broken = moduleFolder() / "stereonav_test_broken.so";
    std::ofstream(broken) << "not a library";
    const std::string message = failureOf("test_broken");
    std::filesystem::remove(broken);
    EXPECT_THAT(message,
                AllOf(HasSubstr("stereonav_test_broken.so: can not be loaded ("), Not(HasSubstr("\n"))));
}

TEST(Module, TheListOfLibrariesHoldsThoseThatAreLoaded) {
    EXPECT_THAT(loadedLibraries(), AllOf(Contains(HasSubstr("/libtbb.so")), Contains(HasSubstr("/libc.so")),
                                         Not(Contains(HasSubstr("libgdal")))));
}

}  // namespace
}  // namespace stereonav
