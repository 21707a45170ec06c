#include "engine/volume/volume_up.h"

namespace stereonav {

std::optional<UpAxis> upAxisFromText(std::string_view text) {
    UpAxis up;
    up.negative = text.starts_with('-');
    if (up.negative) text.remove_prefix(1);
    if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') return std::nullopt;
    up.axis = text[0] - 'x';
    return up;
}

std::string nameOf(const UpAxis& up) {
    return std::string(up.negative ? "-" : "") + static_cast<char>('x' + up.axis);
}

glm::dmat3 turnThatPutsUp(const UpAxis& up) {
    const double s = up.negative ? -1 : 1;
    glm::dmat3 turn(0.0);  // columns: where x, y and z go
    switch (up.axis) {
        case 0:
            turn[0][2] = s;
            turn[1][1] = 1;
            turn[2][0] = -s;
            break;
        case 1:
            turn[0][0] = 1;
            turn[1][2] = s;
            turn[2][1] = -s;
            break;
        default:
            turn[0][0] = s;
            turn[1][1] = 1;
            turn[2][2] = s;
    }
    return turn;
}

void turnUp(VolumeFrame& frame, const UpAxis& up) {
    const glm::dmat3 turn = turnThatPutsUp(up);
    frame.origin = turn * frame.origin;
    frame.axes = turn * frame.axes;
}

}  // namespace stereonav
