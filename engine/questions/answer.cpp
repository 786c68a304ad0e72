#include "engine/questions/answer.hpp"

#include <algorithm>

namespace grainreel {

std::vector<std::int32_t> grains_in(const Answer& answer) {
    std::vector<std::int32_t> ids = answer.grains.value_or(std::vector<std::int32_t>{});
    for (const AnswerTable& table : answer.tables)
        for (std::size_t k = 0; k < table.columns.size(); ++k) {
            const std::string& name = table.columns[k].name;
            if (name != "id" && name != "first" && name != "second") continue;
            for (const auto& row : table.rows)
                if (const auto* id = std::get_if<std::int64_t>(&row[k]))
                    ids.push_back(static_cast<std::int32_t>(*id));
        }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

}  // namespace grainreel
