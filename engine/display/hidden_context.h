// An OpenGL 4.5 context in a window that is never shown, for drawing on other threads than the Window's. The
// Window must exist as long as this object.
#pragma once

#include <mutex>

struct GLFWwindow;

namespace stereonav {

class HiddenContext {
public:
    // Makes the context; construction and destruction must be on the main thread. Throws Error where there is
    // no OpenGL 4.5.
    HiddenContext();
    ~HiddenContext();
    HiddenContext(const HiddenContext&) = delete;
    HiddenContext& operator=(const HiddenContext&) = delete;

    // Makes the context current on this thread while this object lives; another thread waits for its end.
    // Then the former context becomes current again. Null: the current context stays.
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
