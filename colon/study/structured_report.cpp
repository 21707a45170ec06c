#include "colon/study/structured_report.h"

#include "colon/study/structured_report_module.h"
#include "engine/base/module.h"

namespace stereonav {

std::string structuredReportFile(const StructuredReport& report) {
    static const auto& functions =
        moduleFunctions<StructuredReportFunctions>("dcmtk", "to write DICOM structured reports");
    return functions.structuredReportFile(report);
}

}  // namespace stereonav
