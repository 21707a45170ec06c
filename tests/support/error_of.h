// The line that a call throws as an Error.
#pragma once

#include <string>

#include "engine/base/error.h"

namespace stereonav::test {

template <typename Call>
std::string errorOf(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace stereonav::test
