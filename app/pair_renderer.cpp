#include "app/pair_renderer.h"

#include "engine/base/error.h"

namespace stereonav {

PairMethod pairMethodFromText(const std::string& name, const char* option) {
    if (name == "auto") return PairMethod::Sweep;
    std::string known;
    for (const NamedPairMethod& named : kPairMethods) {
        if (named.name == name) return named.method;
        known += (known.empty() ? "" : ", ") + std::string(named.name);
    }
    throw Error(option, "", "there is no method \"" + name + "\" of making two eyes of a medium",
                "the methods are " + known);
}

}  // namespace stereonav
