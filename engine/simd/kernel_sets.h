// STEREONAV_EACH_SET(declarations): what a kernel file defines, declared in the namespace of each instruction
// set that it is compiled for (cmake/rooms.cmake). Processors other than x86 have the plain set alone; the
// names of the others stand for it there, and are never chosen (availableTarget). No code: kernel files
// include this.
#pragma once

#if defined(__x86_64__)
#define STEREONAV_EACH_SET(...) \
    namespace plain {           \
    __VA_ARGS__                 \
    }                           \
    namespace avx2 {            \
    __VA_ARGS__                 \
    }                           \
    namespace avx512 {          \
    __VA_ARGS__                 \
    }
#else
namespace stereonav {
namespace plain {}
namespace avx2 = plain;
namespace avx512 = plain;
}  // namespace stereonav
#define STEREONAV_EACH_SET(...) \
    namespace plain {           \
    __VA_ARGS__                 \
    }
#endif
