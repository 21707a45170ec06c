// GDCM and the codecs behind it print to standard error what they think of a file. For as long as a
// QuietThread lives, nothing that its thread writes through stderr or std::cerr gets out; other threads
// (progress) go on.
#pragma once

namespace stereonav {

class QuietThread {
public:
    QuietThread();
    ~QuietThread();
    QuietThread(const QuietThread&) = delete;
    QuietThread& operator=(const QuietThread&) = delete;
};

}  // namespace stereonav
