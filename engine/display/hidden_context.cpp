// See the header. GLFW may be told from any thread what is current there; windows are the main thread's.
#include "engine/display/hidden_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "engine/base/error.h"

namespace stereonav {

HiddenContext::HiddenContext() {
    constexpr int kSide = 16;  // pixels; nothing is drawn into the window
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    mHandle = glfwCreateWindow(kSide, kSide, "volume light", nullptr, nullptr);
    if (mHandle) return;
    const char* text = nullptr;
    glfwGetError(&text);
    throw Error("", "volume light on the GPU",
                std::string("there is no OpenGL 4.5 here: ") + (text ? text : "no reason given"),
                "update the graphics driver or use the CPU");
}

HiddenContext::~HiddenContext() {
    glfwDestroyWindow(mHandle);
}

HiddenContext::Use::Use(HiddenContext* context) : mContext(context) {
    if (!mContext) return;
    mLock = std::unique_lock(mContext->mUsed);
    mBefore = glfwGetCurrentContext();
    glfwMakeContextCurrent(mContext->mHandle);
    if (glfwGetCurrentContext() == mContext->mHandle) return;
    glfwMakeContextCurrent(mBefore);
    throw Error("", "volume light on the GPU", "the graphics driver lends no second context to this thread",
                "use the CPU");
}

HiddenContext::Use::~Use() {
    if (mContext) glfwMakeContextCurrent(mBefore);
}

}  // namespace stereonav
