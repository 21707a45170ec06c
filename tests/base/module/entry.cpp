// The module of module_test.cpp: what a module can do to the program that loads it.
#include <memory>
#include <numeric>
#include <stdexcept>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/base/parallel.h"
#include "tests/base/module/functions.h"

namespace stereonav {
namespace {

void throwError(const std::string& file) {
    throw Error(file, "line 3", "expected a number", "write one");
}

void throwFromLoop() {
    parallelFor(64, [](int i) {
        if (i == 40) throw Error("", "", "40 is one too many", "");
    });
}

void throwCancelled(Progress& progress) {
    progress.cancel();
    progress.report(0.5, "half");
}

class Adder final : public Sum {
public:
    void add(const std::vector<int>& numbers) override {
        mSum = std::accumulate(numbers.begin(), numbers.end(), mSum);
    }
    int value() const override { return mSum; }

private:
    int mSum = 0;
};

std::unique_ptr<Sum> makeSum() {
    return std::make_unique<Adder>();
}

constexpr TestModuleFunctions kFunctions = {throwError, throwFromLoop, throwCancelled, threadCount, makeSum};

}  // namespace

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
