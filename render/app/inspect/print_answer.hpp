// Answers as text: aligned tables in fitting units for people, JSON and CSV in SI for programs.
#pragma once

#include <string>

#include "engine/questions/answer.hpp"

namespace grainreel {

std::string text_of(const Answer& answer);
// "At 4.02 s (step 21503): brought back"; empty of an answer without a moment.
std::string moment_line(const Answer& answer);

// {"tables": {NAME: {"title", "columns": [{"name", "unit", "about"}], "rows": [[...]]}}, "notes": [...]}
// An empty cell, and a number that is none, is null.
std::string json_of(const Answer& answer);

// Each table with a header of names and units, an empty line between two. An empty cell is empty. Moment and
// notes have no place in it.
std::string csv_of(const Answer& answer);

}  // namespace grainreel
