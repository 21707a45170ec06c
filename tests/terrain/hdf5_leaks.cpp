// What the leak checker leaves aside in this program: libhdf5 loses its own memory over a damaged file, and
// is asked not to tidy up at the end, where it would end by a signal over it (outside_files_test.cpp).
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libhdf5\n";
}
