// The compiler's sanitizers that this is built with: they take memory and make system calls of their own.
#pragma once

namespace stereonav {

#if defined(__has_feature)  // clang
#if __has_feature(address_sanitizer)
#define STEREONAV_ADDRESS_SANITIZER 1
#endif
#if __has_feature(thread_sanitizer)
#define STEREONAV_THREAD_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)  // g++
#define STEREONAV_ADDRESS_SANITIZER 1
#endif
#if defined(__SANITIZE_THREAD__)
#define STEREONAV_THREAD_SANITIZER 1
#endif

#ifdef STEREONAV_ADDRESS_SANITIZER
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif
#ifdef STEREONAV_THREAD_SANITIZER
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif

}  // namespace stereonav
