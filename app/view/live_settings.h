// Settings that the session changes at once, without loading the scene again: the table's keys and the
// session's values, in both directions.
#pragma once

#include <optional>
#include <string>

#include "app/view/session.h"
#include "app/view/setting_texts.h"

namespace stereonav {

// Returns whether the scene takes this key at once; with a text: this value (empty: as the scene began).
bool isLive(const ViewSession& session, const std::string& key);
bool isLive(const ViewSession& session, const std::string& key, const std::optional<std::string>& text);

// Returns `given` with the present live values; those that are as the scene began stay as given.
SettingTexts withLive(const ViewSession& session, SettingTexts given);

// Returns the value in use as a text, whether it was given or not; empty where the session does not know it.
std::optional<std::string> valueNow(const ViewSession& session, const std::string& key);

// Sets a live key. text: in the form of the option; empty: as the scene began. Throws Error like the command
// line.
void setLive(ViewSession& session, const std::string& key, const std::optional<std::string>& text);

// Paints in a new scene what was painted since it was asked for.
void keepPaint(const Scene& before, const Scene& after);

}  // namespace stereonav
