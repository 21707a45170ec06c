#include "app/output/command_result.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "app/output/handed_name.h"
#include "engine/base/file.h"
#include "engine/scene/facts_json.h"
#include "engine/text/json_text.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

std::vector<NamedPlace> withDocument(const Telling& telling, std::vector<NamedPlace> outputs) {
    if (telling.json) outputs.insert(outputs.begin(), {"--json", "-"});
    return outputs;
}

std::string documentOf(const Facts& facts) {
    return jsonText(jsonOf(facts), 2);
}

}  // namespace

CommandResult::CommandResult(const char* command, const Telling& telling,
                             const std::vector<NamedPlace>& outputs)
    : mTelling(telling), mLines(messagesBeside(withDocument(telling, outputs))) {
    add("command", std::string(command));
}

void CommandResult::say(std::string_view line) const {
    if (!mTelling.quiet) answer(line);
}

void CommandResult::answer(std::string_view line) const {
    if (mTelling.json) return;
    if (line.ends_with('\n')) line.remove_suffix(1);
    printLine(mLines, line);
}

void CommandResult::add(std::string key, FactValue value) {
    mFacts.push_back(factForJson(std::move(key), std::move(value)));
}

void CommandResult::addScene(const std::string& scene) {
    add("scene", handedName(scene));
}

void CommandResult::addFile(const std::string& key, const std::filesystem::path& file) {
    FactValue bytes;
    std::error_code code;
    if (!isStandardOutput(file) && std::filesystem::is_regular_file(file, code))
        if (const std::uintmax_t size = std::filesystem::file_size(file, code); !code)
            bytes = static_cast<std::int64_t>(size);
    add(key, Facts{factForJson("path", file.string()), factForJson("bytes", std::move(bytes))});
}

void CommandResult::finish() const {
    if (mTelling.json) printJson(mFacts);
}

void CommandResult::writeTo(const std::filesystem::path& file) const {
    writeTextFile(file, documentOf(mFacts) + "\n");
}

void printJson(const Facts& facts) {
    printDocument(documentOf(facts));
}

}  // namespace stereonav
