// Actions that panels ask for, which are executed after drawing: they may open or close what is being drawn.
#pragma once

#include <utility>
#include <vector>

#include "app/view/view_action.h"

namespace stereonav {

class AskedActions {
public:
    void ask(const ViewAction& action) { mActions.push_back(action); }
    bool any() const { return !mActions.empty(); }
    std::vector<ViewAction> take() { return std::exchange(mActions, {}); }

private:
    std::vector<ViewAction> mActions;
};

}  // namespace stereonav
