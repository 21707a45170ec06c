// The row of the search box that goes to a typed place.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/view/go_to_place.h"

namespace stereonav {

class PlaceRow {
public:
    // Draws where the words lie in the scene, or what is expected, also for other words where `asked`.
    // entered: whether Enter was pressed. Returns whether the session went there.
    bool draw(ViewSession& session, const std::string& words, bool entered, bool asked);
    // Returns whether the last words were a place.
    bool isPlace() const { return mFound.has_value(); }
    void forget();

private:
    std::shared_ptr<const OpenScene> mScene;
    std::string mWords;
    std::optional<FoundPlace> mFound;  // place of these words in this scene
};

}  // namespace stereonav
