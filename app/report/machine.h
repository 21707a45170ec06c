// The machine and the program that a report was measured with.
#pragma once

#include <optional>

#include "app/report/model.h"

namespace stereonav {

// Returns processor, memory, system, compiler, libraries, commit, date, threads, and load at the start.
ReportFacts machineFacts();

// Returns the mean number of tasks that ran or waited in the last minute; empty where the system does not
// report it.
std::optional<double> loadAverage();
// Returns a warning where others were using the machine, otherwise "".
std::string noiseWarning(std::optional<double> load, int processors);

}  // namespace stereonav
