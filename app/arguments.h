// The command line.
#pragma once

namespace stereonav {

// Parses and runs one command; returns the exit status. Throws what the command throws.
int runCommandLine(int argc, char** argv);

}  // namespace stereonav
