// Arguments in the form of GDAL's programs.
#pragma once

#include <cpl_string.h>

#include <string>

namespace stereonav {

class ProgramWords {
public:
    ProgramWords() = default;
    ~ProgramWords() { CSLDestroy(mWords); }
    ProgramWords(const ProgramWords&) = delete;
    ProgramWords& operator=(const ProgramWords&) = delete;

    ProgramWords& add(const std::string& word) {
        mWords = CSLAddString(mWords, word.c_str());
        return *this;
    }
    char** get() { return mWords; }

private:
    char** mWords = nullptr;
};

}  // namespace stereonav
