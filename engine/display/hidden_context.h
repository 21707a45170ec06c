// An OpenGL 4.5 context in a window that is never shown: for drawing on threads beside that of the Window,
// which must be there for its whole life.
#pragma once

#include <mutex>

struct GLFWwindow;

namespace stereonav {

class HiddenContext {
public:
    // Makes the context, on the main thread, as its end. Throws Error where there is no OpenGL 4.5.
    HiddenContext();
    ~HiddenContext();
    HiddenContext(const HiddenContext&) = delete;
    HiddenContext& operator=(const HiddenContext&) = delete;

    // Makes the context current on this thread while it lives, from whatever thread: one waits for another.
    // What was current before is so again at the end. Null: what is current stays.
    class Use {
    public:
        explicit Use(HiddenContext* context);  // throws Error where the driver refuses
        ~Use();
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

    private:
        HiddenContext* mContext;
        std::unique_lock<std::mutex> mLock;
        GLFWwindow* mBefore = nullptr;
    };

private:
    GLFWwindow* mHandle = nullptr;
    std::mutex mUsed;
};

}  // namespace stereonav
