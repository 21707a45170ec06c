#include "engine/text/similar.h"

#include <gtest/gtest.h>

#include <vector>

namespace stereonav {
namespace {

TEST(SimilarWords, AreAsFarAsTheirEdits) {
    EXPECT_EQ(editDistance("", ""), 0);
    EXPECT_EQ(editDistance("", "size"), 4);
    EXPECT_EQ(editDistance("size", ""), 4);
    EXPECT_EQ(editDistance("size", "size"), 0);
    EXPECT_EQ(editDistance("size", "sizes"), 1);
    EXPECT_EQ(editDistance("size", "sze"), 1);
    EXPECT_EQ(editDistance("size", "side"), 1);
    EXPECT_EQ(editDistance("kitten", "sitting"), 3);
}

TEST(SimilarWords, ExchangedNeighboursAreOneEdit) {
    EXPECT_EQ(editDistance("siez", "size"), 1);
    EXPECT_EQ(editDistance("ab", "ba"), 1);
    EXPECT_EQ(editDistance("abcd", "badc"), 2);
    EXPECT_EQ(editDistance("ca", "abc"), 3) << "no place is touched twice";
}

TEST(SimilarWords, TheNearestIsFound) {
    const std::vector<std::string> words{"seed", "side", "size"};
    EXPECT_EQ(nearestWord("siez", words), "size");
    EXPECT_EQ(nearestWord("see", words), "seed");
    EXPECT_EQ(nearestWord("sie", words), "side") << "the first of equals";
    EXPECT_EQ(nearestWord("size", std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace stereonav
