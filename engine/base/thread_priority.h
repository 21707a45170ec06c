// Threads that compute get a lower priority than those that answer the user. Where all cores compute, a
// thread that needs a core for a few milliseconds would otherwise wait tens of milliseconds for its turn.
#pragma once

namespace stereonav {

// Gives this thread, and threads that it starts later, a smaller share of a core that others want too; a core
// that nobody else wants is used as before. Can not be undone: raising a priority takes rights that a user
// does not have. Does nothing where the system has no thread priorities.
void stepBehindTheWindow();

// Lowers the priority of a process that was just started, even further than stepBehindTheWindow(): it may
// compute for hours while the user flies.
void putBehindTheWindow(int process);

}  // namespace stereonav
