// Speed of the machine at the moment: memory traffic by the triad of STREAM (McCalpin 1995), and the time of
// a fixed piece of work, whose spread shows how steady the machine is.
#pragma once

#include "engine/metrics/spread.h"

namespace stereonav {

// Returns the rate of a[i] = b[i] + k c[i] on all threads in GB/s, with 24 bytes per element as STREAM
// counts, the largest of several runs; arrays of 32 MB, larger than the caches of most machines.
double triadRate();

// Returns the milliseconds of a fixed piece of arithmetic on one thread, the least of three.
double fixedWork_ms();

}  // namespace stereonav
