// Answers as text: aligned tables in fitting units for people, JSON and CSV in SI for programs.
#pragma once

#include <string>

#include "engine/inspect/answer.hpp"

namespace grainreel {

std::string text_of(const Answer& answer);

// {"tables": {NAME: {"title", "columns": [{"name", "unit", "about"}], "rows": [[...]]}}, "notes": [...]}
// An empty cell, and a number that is none, is null.
std::string json_of(const Answer& answer);

// Each table with a header of names and units, an empty line between two. An empty cell is empty.
std::string csv_of(const Answer& answer);

}  // namespace grainreel
