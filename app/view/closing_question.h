// Asks before the window closes while work would be lost: the first wish to close asks, and a second one soon
// after it is the answer.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stereonav {

class ClosingQuestion {
public:
    static constexpr double kAsked_s = 10;  // duration of the question

    // Returns whether to close. work: what would be lost, such as "a movie, which is lost". now: seconds of
    // any clock.
    bool wish(const std::vector<std::string>& work, double now);
    // Returns the question while it stands; otherwise "".
    std::string text(const std::vector<std::string>& work, double now) const;
    void goOn() { mAsked.reset(); }

private:
    bool stands(double now) const { return mAsked && now - *mAsked <= kAsked_s; }

    std::optional<double> mAsked;
};

}  // namespace stereonav
