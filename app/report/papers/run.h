// The parts of `report --papers`, in the order of the page.
#pragma once

#include "app/report/run.h"

namespace stereonav {

void reportPapersStereo(ReportRun& run, double seconds);     // Wan et al. 2004
void reportPapersLight(ReportRun& run, double seconds);      // Wyman et al. 2006
void reportPapersMedia(ReportRun& run, double seconds);      // Kniss et al. 2003
void reportPapersOcclusion(ReportRun& run, double seconds);  // Ruiz et al. 2010
void reportPapersScaling(ReportRun& run, double seconds);    // with 1 to all threads

}  // namespace stereonav
