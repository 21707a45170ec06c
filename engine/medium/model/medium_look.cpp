// Names of the models.
#include "engine/medium/model/medium_look.h"

namespace stereonav {

std::string_view nameOf(MediumModel model) {
    switch (model) {
        case MediumModel::Emission:
            return "emission";
        case MediumModel::Surface:
            return "surface";
        case MediumModel::Direct:
            return "direct";
        case MediumModel::Indirect:
            return "indirect";
    }
    return "";
}

}  // namespace stereonav
