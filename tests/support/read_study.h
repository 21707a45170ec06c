// Reads a study, or catches the error of one that can not be read.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "colon/study/study.h"
#include "engine/base/error.h"

namespace stereonav::test {

inline Study read(const std::filesystem::path& file, const StudyOptions& options = {}) {
    Progress progress;
    return readStudy(file, options, progress);
}

inline std::string errorOf(const std::filesystem::path& file, const StudyOptions& options = {}) {
    try {
        read(file, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

// Expects an error of one line that names the file and has all of the parts.
inline void expectError(const std::filesystem::path& file, const std::vector<std::string>& parts,
                        const StudyOptions& options = {}) {
    const std::string message = errorOf(file, options);
    EXPECT_THAT(message,
                testing::AllOf(testing::HasSubstr(file.string()), testing::Not(testing::HasSubstr("\n"))));
    for (const std::string& part : parts) EXPECT_THAT(message, testing::HasSubstr(part));
}

}  // namespace stereonav::test
