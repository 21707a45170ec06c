// Copies texts of panels to the clipboard, with a notice in the window.
#pragma once

#include <optional>
#include <string>

#include "app/view/session.h"
#include "engine/display/window.h"

namespace stereonav {

class Clipboard {
public:
    // window and session must outlive this object.
    Clipboard(Window& window, std::optional<ViewSession>& session) : mWindow(window), mSession(session) {}

    void copy(const std::string& text) const {
        mWindow.setClipboard(text);
        if (mSession) mSession->notify("copied");
    }

private:
    Window& mWindow;
    std::optional<ViewSession>& mSession;
};

}  // namespace stereonav
