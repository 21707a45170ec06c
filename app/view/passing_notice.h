// A line that the window shows for a few seconds.
#pragma once

#include <string>

namespace stereonav {

class PassingNotice {
public:
    const std::string& text() const { return mText; }  // "": none
    void say(const std::string& text) {
        mText = text;
        mLeft = kSeconds;
    }
    // Lets dt seconds pass.
    void step(double dt) {
        if (mLeft > 0 && (mLeft -= dt) <= 0) mText.clear();
    }

private:
    static constexpr double kSeconds = 4;
    std::string mText;
    double mLeft = 0;  // seconds left
};

}  // namespace stereonav
