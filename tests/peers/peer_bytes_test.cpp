#include "engine/peers/peer_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace stereonav {
namespace {

TEST(PeerBytes, ComeBackAsTheyWerePut) {
    const std::vector<double> numbers{0.0, -1.5, 1e300};
    const PeerBytes bytes = ByteWriter()
                                .put(std::uint32_t{7})
                                .putArray(std::span<const double>(numbers))
                                .putText("words")
                                .putText("")
                                .putAll(std::span<const double>(numbers))
                                .take();
    ByteReader reader(bytes);
    EXPECT_EQ(reader.get<std::uint32_t>(), 7u);
    EXPECT_EQ(reader.getArray<double>(), numbers);
    EXPECT_EQ(reader.getText(), "words");
    EXPECT_EQ(reader.getText(), "");
    std::vector<double> all(3);
    reader.getAll(std::span<double>(all));
    EXPECT_EQ(all, numbers);
    EXPECT_EQ(reader.left(), 0u);
    reader.getAll(std::span<double>());  // nothing of nothing
}

TEST(PeerBytes, ThatAreCutOffAreRefused) {
    PeerBytes bytes = ByteWriter().putText("some words").take();
    bytes.pop_back();
    EXPECT_THROW(ByteReader(bytes).getText(), Error);
    EXPECT_THROW(ByteReader(PeerBytes{}).get<char>(), Error);
    // A count that no memory holds is refused before it is asked for.
    const PeerBytes huge = ByteWriter().put(~std::size_t{0}).put(0).take();
    EXPECT_THROW(ByteReader(huge).getArray<double>(), Error);
}

}  // namespace
}  // namespace stereonav
