// Writes answers as text: as aligned tables in fitting units for people, as JSON and CSV in SI units for
// programs.
#pragma once

#include <string>

#include "engine/questions/answer.hpp"

namespace grainreel {

std::string text_of(const Answer& answer);
// The line about the moment, "At 4.02 s (step 21503): brought back"; empty for an answer without a moment.
std::string moment_line(const Answer& answer);

// {"tables": {NAME: {"title", "columns": [{"name", "unit", "about"}], "rows": [[...]]}}, "notes": [...]}
//
// An answer about one moment has "moment" too, and a table whose rows have units of their own has
// "row_units". An empty cell and NaN become null.
std::string json_of(const Answer& answer);

// Writes each table with a header of names and units, and an empty line between tables. An empty cell stays
// empty. The moment and the notes are left out.
std::string csv_of(const Answer& answer);

}  // namespace grainreel
