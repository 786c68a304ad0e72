#include "engine/state/table_mark.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <xxhash.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

TableMark mark_of_table(std::int64_t grains, std::string_view bytes) {
    return {grains, XXH64(bytes.data(), bytes.size(), 0)};
}

std::optional<TableMark> mark_in_run_json(const std::filesystem::path& run_json) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(run_json, ignored)) return std::nullopt;
    std::ifstream file = read_plain(run_json);
    const nlohmann::json document = nlohmann::json::parse(file, nullptr, false);
    if (!document.is_object()) return std::nullopt;
    const auto written = document.find("written");
    if (written == document.end() || !written->is_object()) return std::nullopt;
    const auto table = written->find("final_csv");
    if (table == written->end() || !table->is_object()) return std::nullopt;
    const auto grains = table->find("grains"), sum = table->find("xxh64");
    if (grains == table->end() || !grains->is_number_integer() || sum == table->end() || !sum->is_string())
        return std::nullopt;
    const std::string digits = sum->get<std::string>();
    if (digits.empty() || digits.find_first_not_of("0123456789abcdef") != std::string::npos ||
        digits.size() > 16)
        return std::nullopt;
    return TableMark{grains->get<std::int64_t>(), std::stoull(digits, nullptr, 16)};
}

void check_as_written(const std::filesystem::path& table, std::int64_t grains) {
    if (table.filename() != kFinalTable) return;
    const std::optional<TableMark> written = mark_in_run_json(table.parent_path() / "run.json");
    if (!written) return;
    constexpr const char* advice = "copy it again, or, if you changed it, give it another name";
    if (grains < written->grains)
        throw UserError(fmt::format("{}: was cut off: it has {} of the {} grains that its run wrote; {}",
                                    table.string(), grains, written->grains, advice));
    std::ifstream file = read_plain(table);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (mark_of_table(grains, bytes).checksum != written->checksum)
        throw UserError(
            fmt::format("{}: is not what its run wrote, by the checksum in the run.json beside it; {}",
                        table.string(), advice));
}

}  // namespace grainreel
