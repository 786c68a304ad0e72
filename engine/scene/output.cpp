#include "engine/scene/output.hpp"

namespace grainreel {

// Replaces quotes and separators of CSV, which would break the row.
std::string column_part(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

}  // namespace grainreel
