// The room of a head in a lumen remembers its last answers: whatever was asked before, it answers as one that
// was never asked.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "colon/flight/colon_flight_room.h"
#include "tests/volume/test_volumes.h"

namespace stereonav::test {
namespace {

// Returns the distance free of the wall of a tube of 12 mm along x with a ball of 5 mm on it.
double freeInTube(const glm::dvec3& p, double upTo) {
    const double wall = 0.012 - std::hypot(p.y, p.z), ball = glm::distance(p, {0.02, 0.012, 0}) - 0.005;
    return std::min({wall, ball, upTo});
}

LumenRoom roomInTube() {
    return LumenRoom(freeInTube, 0.003, 0.0015, {{{0.02, 0, 0}, 0.004, 0.002}});
}

TEST(LumenRoom, AnswersWhateverWasAskedBefore) {
    const LumenRoom asked = roomInTube();
    Random random(5);
    const std::vector<glm::dvec3> heads{
        {0, 0, 0},       {0, 0.002, 0}, {0, 0.002, 0.003}, {0.019, 0.001, 0.001}, {0.018, 0.001, 0.001},
        {0.02, 0.003, 0}};
    const std::vector<glm::dvec3> rights{{0, 1, 0}, {0, 0, 1}, {0, 0.6, 0.8}, {0.6, 0, 0.8}};
    const std::vector<double> reaches{0.0001, 0.001, 0.004, 0.02};
    const auto some = [&](const auto& list) {
        return list[static_cast<std::size_t>(random.below(int(list.size())))];
    };
    glm::dvec3 head = heads[0], right = rights[0];
    double upTo = reaches[0];
    for (int n = 0; n < 4000; ++n) {
        // One thing after the other is another one.
        const int what = random.below(4);
        if (what == 0) head = some(heads);
        if (what == 1) right = some(rights);
        if (what == 2) upTo = some(reaches);
        if (what == 3) head += 1e-4 * random.direction();
        SCOPED_TRACE(n);
        const LumenRoom fresh = roomInTube();
        ASSERT_NEAR(asked.room(head, right, upTo), fresh.room(head, right, upTo), 1e-12);
        const LumenRoom other = roomInTube();
        ASSERT_NEAR(asked.free(head, right, upTo), other.free(head, right, upTo), 1e-12);
        const glm::dvec3 away = asked.away(head, right), expected = roomInTube().away(head, right);
        ASSERT_LT(glm::distance(away, expected), 1e-6);
    }
}

}  // namespace
}  // namespace stereonav::test
