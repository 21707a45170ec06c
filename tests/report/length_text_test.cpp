// Lengths as they are said: kilometres, metres or millimetres, with the digits that their size has.
#include "app/output/length_text.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

TEST(LengthText, SaysEachSizeInItsUnit) {
    for (const auto& [metres, words] : {std::pair(12345.6, "12.35 km"),
                                        {1000.0, "1.00 km"},
                                        {999.4, "999 m"},
                                        {123.45, "123 m"},
                                        {12.345, "12.3 m"},
                                        {1.2345, "1.23 m"},
                                        {0.5, "0.50 m"},
                                        {0.1, "0.10 m"},
                                        {0.0999, "99.9 mm"},
                                        {0.0123, "12.3 mm"},
                                        {0.0, "0.0 mm"},
                                        {-0.05, "-50.0 mm"},
                                        {-12.0, "-12.00 m"}})
        EXPECT_EQ(lengthText(metres), words) << metres;
}

}  // namespace
}  // namespace stereonav
