// What the window tells: lines on standard output and in the document that --json asks for, and a failure,
// which stays in the window until it is read.
#pragma once

#include <functional>
#include <string>

#include "app/options/picture_options.h"
#include "app/output/command_result.h"

namespace stereonav {

class Notices {
public:
    explicit Notices(const ViewOptions& options);

    // A line, which stays useful after the window is closed; "" is none.
    void tell(const std::string& text);

    // One line; "": none.
    const std::string& failure() const { return mFailure; }
    void fail(const std::string& problem) { mFailure = problem; }
    void forgetFailure() { mFailure.clear(); }
    // An exception of it becomes the failure.
    void tryTo(const std::function<void()>& what);

    // The document, whose other fields others add.
    CommandResult& result() { return mResult; }
    // Prints and writes it when the window is closed. scene: its name. Throws Error.
    void finish(const std::string& scene);

private:
    CommandResult mResult;
    FactWords mTold;
    std::string mJson;  // the document's file; "": none
    std::string mFailure;
};

}  // namespace stereonav
