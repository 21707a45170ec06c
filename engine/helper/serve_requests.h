// The helper's side of a helper program (engine/base/helper_program.h).
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace stereonav {

// Goes into the sandbox (sandbox.h), then answers until the program closes its end; what `answer` throws is
// told to the program. What a library loads when it is first used has to be loaded before. Returns main's
// status.
int serveRequests(const std::function<std::string(std::string_view request)>& answer);

}  // namespace stereonav
