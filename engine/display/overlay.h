// Text over the picture: the line of live figures, help, notices and progress, through Dear ImGui.
// It is drawn once for each eye's place, so that it can be read in stereo.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stereonav {

class Window;

// Part of the window, as shares of its size, (0, 0) top left.
struct OverlayArea {
    float x = 0, y = 0, width = 1, height = 1;
};

struct OverlayContent {
    std::string status;                                     // the line at the bottom, "" for none
    std::string warning;                                    // over it, in a warning colour
    std::string notice;                                     // at the top: what just happened
    std::vector<std::pair<std::string, std::string>> help;  // keys, what they do; empty for none
    std::optional<double> progress;                         // a bar in the middle, 0 to 1
    std::string progressText;

    bool operator==(const OverlayContent&) const = default;
};

// Needs the window's context to be current. One at a time.
class Overlay {
public:
    explicit Overlay(const Window& window);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    void draw(const OverlayContent& content, const std::vector<OverlayArea>& areas);

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
