// What studies ask of the module stereonav_dcmtk; colon/study/dcmtk has the function.
#pragma once

#include "colon/study/structured_report.h"

namespace stereonav {

struct StructuredReportFunctions {
    decltype(&stereonav::structuredReportFile) structuredReportFile;
};

}  // namespace stereonav
