// Options of the address sanitizer for a test program. OpenCV's and libjxl's libraries are opened and left
// while threads end; the leak checker of g++ 12 then follows thread-local memory that is gone, and crashes
// after tests that passed.
extern "C" const char* __asan_default_options() {
    return "intercept_tls_get_addr=0";
}
