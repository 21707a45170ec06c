// The table of the module stereonav_test.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/progress.h"

namespace stereonav {

class Sum {
public:
    virtual ~Sum() = default;
    virtual void add(const std::vector<int>& numbers) = 0;
    virtual int value() const = 0;
};

struct TestModuleFunctions {
    void (*throwError)(const std::string& file);
    void (*throwFromLoop)();
    void (*throwCancelled)(Progress& progress);
    int (*threads)();
    std::unique_ptr<Sum> (*makeSum)();
};

}  // namespace stereonav
