// The ends of a run of which several processes may be part (engine/peers/peers.h): joining the others before
// the command line is read, and telling an error once.
#pragma once

#include <string>

namespace stereonav {

// Where this process was started as one of several and the command is one that shares its work: joins them,
// and prints nothing on standard output unless it is the first. Throws Error.
void joinOthers(int argc, char** argv);

// At the end of a command: waits for the others, or, after a stop, ends them.
void leaveOthers();

// Tells a line on standard error, and ends the others too. The exit status: 1.
int endWith(const std::string& line);
// After a stop that the user or the system asked for.
int endStopped();

}  // namespace stereonav
