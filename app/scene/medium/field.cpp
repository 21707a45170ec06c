#include "app/scene/medium/field.h"

#include <utility>

namespace stereonav {

void putField(std::shared_ptr<const GreyVolume> field, Perturbation noise, MediumScene& shown) {
    const MediumTransfer transfer = findMediumTransfer(shown.transfer);
    shown.medium = Medium(field, transfer, noise);
    shown.makeSurface = [field = std::move(field), transfer, noise = std::move(noise)] {
        return Medium(field, allSurface(transfer), noise);
    };
}

}  // namespace stereonav
