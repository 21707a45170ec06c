// What the machine itself can do at the moment: memory traffic by the triad of STREAM (McCalpin 1995), and
// the same work done again and again, whose spread is the machine's mood.
#pragma once

#include "engine/metrics/spread.h"

namespace stereonav {

// GB/s of a[i] = b[i] + k c[i] on all threads, 24 bytes an element as STREAM counts, the largest of some
// runs; arrays of 32 MB, beyond the caches of most machines.
double triadRate();

// Milliseconds of a fixed piece of arithmetic on one thread, the least of three.
double fixedWork_ms();

}  // namespace stereonav
