// The beginning and end of a run of several processes (engine/peers/peers.h): joins them before the command
// line is read, and reports an error once.
#pragma once

#include <string>

namespace stereonav {

// Joins the other processes where this one was started as one of several and the command shares its work.
// Only the first prints on standard output. Throws Error.
void joinOthers(int argc, char** argv);

// Waits for the other processes at the end of a command, or ends them after a stop.
void leaveOthers();

// Prints a line on standard error and ends the other processes. Returns the exit status, 1.
int endWith(const std::string& line);
// Ends after a stop by the user or the system. Returns the exit status.
int endStopped();

}  // namespace stereonav
