// The content of a structured report, as DCMTK's tree of template TID 1500.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include "colon/study/structured_report.h"

namespace stereonav {

// Throws Error naming what could not be said.
void check(const OFCondition& done, const char* what);

// Adds the content to a new document. Throws Error.
void addContent(const StructuredReport& report, DSRDocument& document);

}  // namespace stereonav
