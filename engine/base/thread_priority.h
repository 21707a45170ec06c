// Threads that compute step back behind those that answer the user. Where all cores compute, a thread that
// wants a core for a few milliseconds otherwise waits for its turn, tens of milliseconds.
#pragma once

namespace stereonav {

// This thread and those that it starts later get a smaller share of a core that others want too, and as much
// as before of one that nobody wants. Never undone: to raise a priority takes rights that a user has not.
// Does nothing where the system has no priorities of threads.
void stepBehindTheWindow();

// Puts a process that was just started behind too, and further: what it computes may take hours, and the
// flight goes on.
void putBehindTheWindow(int process);

}  // namespace stereonav
