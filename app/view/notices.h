// Messages of the window: lines on standard output and in the document of --json, and a failure, which stays
// in the window until it is read.
#pragma once

#include <functional>
#include <string>

#include "app/options/view_options.h"
#include "app/output/command_result.h"

namespace stereonav {

class Notices {
public:
    explicit Notices(const ViewOptions& options);

    // Prints a line that is useful after the window is closed, too; "" prints nothing.
    void tell(const std::string& text);

    // Returns one line; "": none.
    const std::string& failure() const { return mFailure; }
    void fail(const std::string& problem) { mFailure = problem; }
    void forgetFailure() { mFailure.clear(); }
    // Calls `what`; an exception becomes the failure.
    void tryTo(const std::function<void()>& what);

    // Returns the document, to which others add fields.
    CommandResult& result() { return mResult; }
    // Prints and writes the document when the window is closed. scene: its name. Throws Error.
    void finish(const std::string& scene);

private:
    CommandResult mResult;
    FactWords mTold;
    std::string mJson;  // file of the document; "": none
    std::string mFailure;
};

}  // namespace stereonav
