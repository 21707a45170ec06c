// What a helper program can still do once it reads what strangers have sent: take memory, reckon, and talk to
// the program through the socket that it has.
#pragma once

namespace stereonav {

// From now on, for all threads and for good: no file is opened or made, no process or thread started, nothing
// sent but through what is open already, and no new rights come from anywhere. Calls of the system that are
// not on the list fail (EPERM): libraries go on without. Returns false where the system knows filters of
// calls and does not take this one; where it knows none (not Linux's own, or built without seccomp), the
// limits on files and processes are what there is. Builds with sanitizers, which open files and map memory as
// they like, keep out of it.
bool enterSandbox();

}  // namespace stereonav
