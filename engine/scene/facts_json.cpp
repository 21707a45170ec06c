#include "engine/scene/facts_json.h"

#include <nlohmann/json.hpp>

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

struct JsonOf {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const Facts& facts) const { return jsonOf(facts); }
    Json operator()(const std::vector<Facts>& groups) const {
        Json list = Json::array();
        for (const Facts& facts : groups) list.push_back(jsonOf(facts));
        return list;
    }
    template <typename T>
    Json operator()(const T& value) const {
        return value;
    }
};

}  // namespace

Json jsonOf(const Facts& facts) {
    Json json = Json::object();
    for (const Fact& fact : facts)
        if (!fact.key.empty()) json[fact.key] = std::visit(JsonOf{}, fact.value);
    return json;
}

}  // namespace stereonav
