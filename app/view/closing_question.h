// Whether the window may close while something is at work that would end with it: the first wish asks, and a
// second one soon after it is the answer.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stereonav {

class ClosingQuestion {
public:
    static constexpr double kAsked_s = 10;  // how long the question stands

    // work: what would end, as "a movie, which is lost". now: seconds, of any clock. Whether to close.
    bool wish(const std::vector<std::string>& work, double now);
    // The question while it stands; "" else.
    std::string text(const std::vector<std::string>& work, double now) const;
    void goOn() { mAsked.reset(); }

private:
    bool stands(double now) const { return mAsked && now - *mAsked <= kAsked_s; }

    std::optional<double> mAsked;
};

}  // namespace stereonav
