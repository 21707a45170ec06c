// Which way up a volume is whose file does not say it.
#pragma once

#include <optional>
#include <string>

#include "colon/scene/value_kinds.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

struct GuessedUp {
    std::optional<UpAxis> up;  // nothing: nothing speaks against z
    std::string why;           // one clause
};

// A body in CT: the end of z where the skull encloses the head, or where the lungs are. Something else: the
// axis at whose lower end it could stand, on a flat base that the upper end has not, and with its weight
// below. stored: the number from which on something is there.
GuessedUp guessUp(const GreyVolume& grey, const ValueKinds& kinds, double stored);

}  // namespace stereonav
