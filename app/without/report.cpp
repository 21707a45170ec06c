// Stands in for the report, which needs all kinds of scenes and lights.
#include "app/command/commands.h"
#include "engine/base/error.h"

namespace stereonav {

int runReport(const ReportOptions&) {
    throw Error("", "", "this stereonav was built without parts that the report is about",
                "build it with terrain, colon and volume light, as it is by default");
}

}  // namespace stereonav
