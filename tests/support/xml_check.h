// Check of well-formed XML by Expat, which is independent of this project.
#pragma once

#include <expat.h>

#include <string>

namespace stereonav::test {

// Returns "" for well-formed text, else what is wrong and in which line.
inline std::string xmlProblem(const std::string& text) {
    XML_Parser parser = XML_ParserCreate("UTF-8");
    std::string problem;
    if (XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1) == XML_STATUS_ERROR)
        problem = std::string(XML_ErrorString(XML_GetErrorCode(parser))) + " in line " +
                  std::to_string(XML_GetCurrentLineNumber(parser));
    XML_ParserFree(parser);
    return problem;
}

}  // namespace stereonav::test
