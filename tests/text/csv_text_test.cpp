// Cells of tables: RFC 4180, and what spreadsheets take for formulas (OWASP, CSV injection).
#include "engine/text/csv_text.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

TEST(CsvText, IsQuoted) {
    EXPECT_EQ(csvText(""), "\"\"");
    EXPECT_EQ(csvText("ridge"), "\"ridge\"");
    EXPECT_EQ(csvText("a \"small\" hill, seen; twice"), "\"a \"\"small\"\" hill, seen; twice\"");
    EXPECT_EQ(csvText("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csvText("Höhe"), "\"Höhe\"");
}

TEST(CsvText, FormulasAreText) {
    for (const std::string text :
         {"=1+1", "+1", "-1", "@SUM(A1)", "=cmd|' /C calc'!A0", "-2+3+cmd|' /C calc'!A0", " =1", "\u00a0=1",
          "'=1", "\n=1", "\n1", "\uff1d1", "\uff0b1", "\uff0d1", "\uff201"})
        EXPECT_EQ(csvText(text), "\"'" + text + "\"") << text;
    EXPECT_EQ(csvText("\t=1"), "\"'\t=1\"");
    EXPECT_EQ(csvText("\tx"), "\"'\tx\"");
    EXPECT_EQ(csvText("\rx"), "\"'\\x0dx\"");
    EXPECT_EQ(csvText("\"=1"), "\"'\"\"=1\"");
    EXPECT_EQ(csvText("\x1b=1"), "\"'\\x1b=1\"");
    EXPECT_EQ(csvText("\ufeff=1"), "\"'\\xef\\xbb\\xbf=1\"");
}

TEST(CsvText, OtherTextHasNoGuard) {
    for (const std::string text : {"a=b", "x-y", "1-2", "e@mail", "'quoted'", "(=)", "\u00b1 3"})
        EXPECT_EQ(csvText(text), "\"" + text + "\"") << text;
}

TEST(CsvText, IsPrintable) {
    EXPECT_EQ(csvText("a\x1b[2J\xff\u009b"), "\"a\\x1b[2J\\xff\\xc2\\x9b\"");
}

}  // namespace
}  // namespace stereonav
