#include "app/options/built_without.h"

#include "engine/base/error.h"

namespace stereonav {

const char* versionNumber() {
    return STEREONAV_VERSION;
}

const char* versionDate() {
    return STEREONAV_DATE;
}

std::string versionText() {
    const std::string version = "stereonav " STEREONAV_VERSION, without = STEREONAV_WITHOUT;
    return without.empty() ? version : version + "\nbuilt without " + without;
}

void throwBuiltWithout(const std::string& part, const std::string& option) {
    throw Error("", "", "this stereonav was built without " + part, "build it with -D" + option + "=ON");
}

}  // namespace stereonav
