// Settings that the session changes at once, without reading the scene again: the table's keys against the
// session's values, in both directions.
#pragma once

#include <optional>
#include <string>

#include "app/view/session.h"
#include "app/view/setting_texts.h"

namespace stereonav {

// Whether the scene takes this key at once; with a text: this value (none: as the scene began).
bool isLive(const ViewSession& session, const std::string& key);
bool isLive(const ViewSession& session, const std::string& key, const std::optional<std::string>& text);

// `given` with the live values as they are now; what is as the scene began is as it was given.
SettingTexts withLive(const ViewSession& session, SettingTexts given);

// The value in use now, as a text, whether it was given or not: none where the session does not know it.
std::optional<std::string> valueNow(const ViewSession& session, const std::string& key);

// Sets a live key: text as the option takes it, none: as the scene began. Throws Error as the command line.
void setLive(ViewSession& session, const std::string& key, const std::optional<std::string>& text);

// What was painted since a scene was asked for is painted in that scene too.
void keepPaint(const Scene& before, const Scene& after);

}  // namespace stereonav
