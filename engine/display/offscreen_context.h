// An OpenGL 3.3 core context without any display: EGL's surfaceless platform (Mesa).
// Current on the thread that made it, as long as it lives.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace stereonav {

class OffscreenContext {
public:
    OffscreenContext() {
        // Asking for a function that EGL does not have would end the program.
        if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
            !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
            return;
        mDisplay = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (mDisplay == EGL_NO_DISPLAY || !eglInitialize(mDisplay, nullptr, nullptr)) return;
        if (!eglBindAPI(EGL_OPENGL_API)) return;
        const EGLint choice[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(mDisplay, choice, &config, 1, &count) || count < 1) return;
        const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
        mContext = eglCreateContext(mDisplay, config, EGL_NO_CONTEXT, wanted);
        mCurrent = mContext != EGL_NO_CONTEXT &&
                   eglMakeCurrent(mDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, mContext) == EGL_TRUE;
    }
    ~OffscreenContext() {
        if (mDisplay == EGL_NO_DISPLAY) return;
        eglMakeCurrent(mDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (mContext != EGL_NO_CONTEXT) eglDestroyContext(mDisplay, mContext);
        eglTerminate(mDisplay);
    }
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    bool current() const { return mCurrent; }  // false where there is no such platform

private:
    EGLDisplay mDisplay = EGL_NO_DISPLAY;
    EGLContext mContext = EGL_NO_CONTEXT;
    bool mCurrent = false;
};

}  // namespace stereonav
