// The flight that is played: recorded, cut, smoothed, kept, made into a movie.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

void drawPathPanel(PanelHost& host, ViewSession& session);

}  // namespace stereonav
