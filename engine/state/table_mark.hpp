// What run.json keeps of final.csv, so that a table that was cut off or damaged is not believed. The table
// itself stays a plain CSV: nothing in it says where it ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace grainreel {

inline constexpr const char* kFinalTable = "final.csv";

struct TableMark {
    std::int64_t grains = 0;
    std::uint64_t checksum = 0;  // XXH64 of the file's bytes
};

TableMark mark_of_table(std::int64_t grains, std::string_view bytes);

// The mark of a run's final.csv, from the run.json in its folder. None where that file has none.
std::optional<TableMark> mark_in_run_json(const std::filesystem::path& run_json);

// A table of that many grains, which lies beside a run.json. Throws UserError when it is a final.csv that its
// run wrote with others, or with other bytes. A table of another name is nobody's, and may be changed.
void check_as_written(const std::filesystem::path& table, std::int64_t grains);

}  // namespace grainreel
