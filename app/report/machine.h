// What a report was measured on and with: so that figures are read for what they are.
#pragma once

#include <optional>

#include "app/report/model.h"

namespace stereonav {

// Processor, memory, system, compiler, libraries, commit, date, threads, load at the start.
ReportFacts machineFacts();

// Tasks that ran or waited in the last minute, as the system counts them; none where it does not.
std::optional<double> loadAverage();
// Says that others were using the machine, where they were: "" on a quiet one.
std::string noiseWarning(std::optional<double> load, int processors);

}  // namespace stereonav
