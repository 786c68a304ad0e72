// The list of grains that an answer is about.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

struct ListedColumn {
    AnswerColumn column;
    std::function<AnswerCell(std::size_t)> of;  // a grain's place in the frame
};

// Notes the ids of all grains found, for a picture, and adds a table of the first `most` of them: id,
// species, place, and `more`. There is no table where `most` is 0.
void add_grain_list(Answer& answer, const Snapshot& snapshot, const std::vector<std::size_t>& found,
                    std::size_t most, const std::vector<ListedColumn>& more);

}  // namespace grainreel
