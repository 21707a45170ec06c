#include "app/options/output_place.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

// Returns the path without a slash at its end: "folder/" is "folder".
fs::path withoutSlash(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

}  // namespace

void checkOutputFolder(const std::string& option, const fs::path& folder) {
    if (isStandardOutput(folder))
        throw Error(option, "", "expected a folder for several files, got \"" + folder.string() + "\"",
                    "name a folder");
    const fs::path own = withoutSlash(folder);
    std::error_code code;
    try {
        if (fs::exists(own, code))
            checkPlaceForFile(own / ".stereonav");
        else
            checkPlaceForFile(own);
    } catch (const Error& error) {
        throw Error(option, "", error.what(), "");
    }
}

void makeOutputFolder(const fs::path& folder) {
    std::error_code code;
    const fs::path own = withoutSlash(folder);
    fs::create_directory(own, code);
    if (!fs::is_directory(own, code))
        throw Error(folder.string(), "", "can not be made", "name a folder in one that can be written");
}

void checkOutputFile(const std::string& option, const fs::path& file) {
    std::error_code code;
    if (!file.has_filename() || fs::is_directory(file, code))
        throw Error(option, "", "expected a file, got the folder \"" + file.string() + "\"",
                    "add a file name");
    try {
        checkPlaceForFile(file);
    } catch (const Error& error) {
        throw Error(option, "", error.what(), "");
    }
}

void checkOutputToReadAgain(const std::string& option, const fs::path& file) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (isStandardOutput(file) ||
        (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)))
        throw Error(option, "", "expected a file, which later runs read again, got \"" + file.string() + "\"",
                    "name a file");
    checkOutputFile(option, file);
}

void checkOutputPicture(const std::string& option, const fs::path& file) {
    if (isStandardOutput(file)) return;
    if (!file.has_extension() || !canWritePicture(file.extension().string()))
        throw Error(option, "", "\"" + file.string() + "\" has no extension of a picture that can be written",
                    "use .png or .jpg");
    checkOutputFile(option, file);
}

void checkNoInput(const NamedPlace& output, const std::vector<NamedPlace>& inputs) {
    std::error_code code;
    if (output.place.empty() || !fs::is_regular_file(output.place, code)) return;
    for (const NamedPlace& input : inputs)
        if (!input.place.empty() && fs::equivalent(output.place, input.place, code) && !code)
            throw Error(output.option, "",
                        "\"" + output.place + "\" is what is read as " + input.option + ", and would be lost",
                        "name another file");
}

void checkNotRead(std::initializer_list<NamedPlace> outputs) {
    for (const NamedPlace& output : outputs) {
        if (output.place.empty()) continue;
        try {
            checkIsNoInput(output.place);
        } catch (const Error& error) {
            throw Error(output.option, "", error.what(), "");
        }
    }
}

std::FILE* messagesBeside(const std::vector<NamedPlace>& outputs) {
    bool toStandardOutput = false;
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->place.empty()) continue;
        const bool standard = isStandardOutput(output->place);
        for (auto earlier = outputs.begin(); earlier != output; ++earlier)
            if (earlier->place == output->place || (standard && isStandardOutput(earlier->place)))
                throw Error(
                    output->option, "",
                    fmt::format("goes to \"{}\", where {} goes already", output->place, earlier->option),
                    "give each a place of its own");
        toStandardOutput = toStandardOutput || standard;
    }
    return toStandardOutput ? stderr : stdout;
}

}  // namespace stereonav
