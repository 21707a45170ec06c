#include "app/command/info_series.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/options/output_place.h"
#include "app/output/handed_name.h"
#include "app/scene/scene_type_table.h"
#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/text/json_text.h"
#include "engine/text/printable.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path pictureFile(const std::string& folder, std::size_t number) {
    return std::filesystem::path(folder) / fmt::format("series_{}.png", number);
}

Json jsonOf(const std::vector<SeriesLook>& looks, const std::string& folder) {
    Json list = Json::array();
    for (std::size_t n = 0; n < looks.size(); ++n) {
        const SeriesLook& look = looks[n];
        Json entry{
            {"number", n + 1},           {"uid", look.info.uid},       {"description", look.info.description},
            {"modality", look.modality}, {"slices", look.info.slices}, {"size", {look.columns, look.rows}}};
        if (look.problem.empty())
            entry["picture"] = pictureFile(folder, n + 1).string();
        else
            entry["problem"] = look.problem;
        list.push_back(std::move(entry));
    }
    return list;
}

std::string lineOf(const SeriesLook& look, std::size_t number, const std::string& folder) {
    return fmt::format("  {:<3} {} slices of {} x {}  {}  \"{}\"  {}", number, look.info.slices, look.columns,
                       look.rows, look.modality, printable(look.info.description),
                       look.problem.empty() ? pictureFile(folder, number).string() : look.problem);
}

}  // namespace

int listSeries(const SceneOptions& study, const std::string& folder, bool json) {
    checkOutputFolder("--series-pictures", folder);
    sceneTypeNamed(study.scene);  // throws where nothing has this name
    if (study.threads > 0) setThreadCount(study.threads);
    const std::vector<SeriesLook> looks = lookAtSeries(study.scene);
    makeOutputFolder(folder);
    for (std::size_t n = 0; n < looks.size(); ++n)
        if (looks[n].problem.empty()) writeColorImage(pictureFile(folder, n + 1), looks[n].picture);
    if (json) {
        const Json list{{"scene", handedName(study.scene)}, {"series", jsonOf(looks, folder)}};
        printDocument(jsonText(list, 2));
        return 0;
    }
    printLine(stdout, study.scene);
    for (std::size_t n = 0; n < looks.size(); ++n) printLine(stdout, lineOf(looks[n], n + 1, folder));
    return 0;
}

}  // namespace stereonav
