#include "render/app/inspect/print_answer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/text/units.hpp"
#include "render/scene/axis_titles.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

using Json = nlohmann::ordered_json;

// Number of characters of a UTF-8 text: its bytes without those that continue a character.
std::size_t characters(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string si_unit(Dimension dimension) {
    return dimension == Dimension::number ? "" : text_of(dimension).unit;
}

std::string si_unit(const AnswerColumn& column) {
    return column.unit.empty() ? si_unit(column.dimension) : column.unit;
}

// Dimension of a cell; in some tables the rows have dimensions of their own.
Dimension dimension_of(const AnswerTable& table, std::size_t row, std::size_t column) {
    const Dimension own = table.columns[column].dimension;
    return own == Dimension::number && row < table.row_dimensions.size() ? table.row_dimensions[row] : own;
}

// Chooses the units of an answer: one for each dimension, the same in all tables. The unit suits the
// geometric mean of two numbers: the largest number of that dimension, and the geometric mean of the columns'
// largest numbers. It is made larger if a number would have more than four digits before the point.
class Units {
  public:
    explicit Units(const Answer& answer) {
        std::map<Dimension, Seen> all;
        for (const AnswerTable& table : answer.tables) see(table, all);
        for (const auto& [dimension, seen] : all) {
            if (seen.count == 0) continue;
            double typical = std::sqrt(seen.most * std::exp(seen.logarithms / seen.count));
            std::string unit = fitting_unit(typical, dimension);
            while (seen.most >= 1e4 * unit_size(unit, dimension) && typical < seen.most)
                unit = fitting_unit(typical *= 10, dimension);
            unit_[dimension] = unit;
        }
    }
    std::string of(const AnswerColumn& column) const {
        return column.unit.empty() ? of(column.dimension) : column.unit;
    }
    // The unit of a dimension; empty for pure numbers.
    std::string of(Dimension dimension) const {
        if (dimension == Dimension::number) return "";
        const auto found = unit_.find(dimension);
        return found == unit_.end() ? fitting_unit(1, dimension) : found->second;
    }

  private:
    struct Seen {
        // Sums over the largest numbers of the columns or rows: their largest, the sum of their logarithms,
        // and how many they are.
        double most = 0, logarithms = 0, count = 0;
    };

    static void see(const AnswerTable& table, std::map<Dimension, Seen>& all) {
        std::map<std::pair<Dimension, std::size_t>, double>
            largest;  // largest number of a column, or of a row with its own dimension
        for (std::size_t row = 0; row < table.rows.size(); ++row)
            for (std::size_t k = 0; k < table.columns.size(); ++k) {
                const double* value = std::get_if<double>(&table.rows[row][k]);
                const Dimension dimension = dimension_of(table, row, k);
                if (!value || !std::isfinite(*value) || dimension == Dimension::number) continue;
                double& most = largest[{dimension, table.row_dimensions.empty() ? k : row}];
                most = std::max(most, std::abs(*value));
            }
        for (const auto& [where, most] : largest)
            all[where.first].most = std::max(all[where.first].most, most);
        for (const auto& [where, most] : largest) {
            constexpr double rounding = 1e-6;  // smaller numbers are rounding errors of a sum that is 0
            Seen& seen = all[where.first];
            if (most <= rounding * seen.most) continue;
            seen.logarithms += std::log(most);
            seen.count += 1;
        }
    }

    std::map<Dimension, std::string> unit_;
};

constexpr const char* no_value = "-";

std::string for_people(const AnswerCell& cell, double unit) {
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? fmt::format("{:.4g}", *value / unit) : no_value;
}

bool is_words(const AnswerTable& table, std::size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

struct Block {
    std::vector<std::string> lines;  // the heading comes first
    std::size_t width = 0;           // characters
    bool left = false;  // whether the block is aligned left, as words are; numbers are aligned right
};

Block block_of(const AnswerTable& table, std::size_t column, const Units& units) {
    Block block;
    block.left = is_words(table, column);
    block.lines.push_back(with_unit(table.columns[column].name, units.of(table.columns[column])));
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const Dimension dimension = dimension_of(table, row, column);
        std::string cell = for_people(table.rows[row][column], unit_size(units.of(dimension), dimension));
        // The first column says what the row is, so it gets the row's unit.
        if (column == 0 && row < table.row_dimensions.size())
            cell = with_unit(cell, units.of(table.row_dimensions[row]));
        block.lines.push_back(std::move(cell));
    }
    for (const std::string& line : block.lines) block.width = std::max(block.width, characters(line));
    return block;
}

std::string padded(const std::string& text, const Block& block) {
    const std::string space(block.width - characters(text), ' ');
    return block.left ? text + space : space + text;
}

std::string wide_table(const AnswerTable& table, const Units& units) {
    std::vector<Block> blocks;
    for (std::size_t k = 0; k < table.columns.size(); ++k) blocks.push_back(block_of(table, k, units));
    std::string text;
    for (std::size_t row = 0; row <= table.rows.size(); ++row) {
        std::string line;
        for (const Block& block : blocks)
            line += (line.empty() ? "  " : "   ") + padded(block.lines[row], block);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

// Prints a single row of many columns with one line for each column.
std::string tall_table(const AnswerTable& table, const Units& units) {
    std::size_t width = 0;
    for (const AnswerColumn& column : table.columns) width = std::max(width, column.name.size());
    std::string text;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        const AnswerColumn& column = table.columns[k];
        const std::string unit = units.of(column);
        const double size = unit_size(units.of(column.dimension), column.dimension);
        const std::string value = for_people(table.rows[0][k], size);
        const std::string shown = value == no_value ? "none" : value + (unit.empty() ? "" : " " + unit);
        text += fmt::format("  {:<{}}  {}{}{}\n", column.name, width, shown,
                            column.about.empty() ? "" : "   ", column.about);
    }
    return text;
}

Json json_cell(const AnswerCell& cell) {
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_table(const AnswerTable& table) {
    Json columns = Json::array(), rows = Json::array();
    for (const AnswerColumn& column : table.columns)
        columns.push_back({{"name", column.name}, {"unit", si_unit(column)}, {"about", column.about}});
    for (const auto& row : table.rows) {
        Json cells = Json::array();
        for (const AnswerCell& cell : row) cells.push_back(json_cell(cell));
        rows.push_back(std::move(cells));
    }
    Json all = {{"title", table.title}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
    for (const Dimension dimension : table.row_dimensions) all["row_units"].push_back(si_unit(dimension));
    return all;
}

std::string csv_words(const std::string& words) {
    if (words.find_first_of(",\"\n\r") == std::string::npos) return words;
    std::string quoted = "\"";
    for (const char c : words) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csv_cell(const AnswerCell& cell) {
    if (const auto* words = std::get_if<std::string>(&cell)) return csv_words(*words);
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string moment_line(const Answer& answer) {
    if (!answer.moment) return "";
    const AnswerMoment& moment = *answer.moment;
    if (!std::isfinite(moment.time)) return "At a time that is not known";
    const std::string step = moment.step ? fmt::format(" (step {})", *moment.step) : "";
    return fmt::format("At {:.6g} s{}: {}", moment.time, step, moment.how);
}

std::string text_of(const Answer& answer) {
    constexpr std::size_t widest = 7;  // largest number of columns that a single row shows side by side
    const Units units(answer);
    std::string text = moment_line(answer);
    if (!text.empty()) text += "\n";
    for (const AnswerTable& table : answer.tables) {
        text += (text.empty() ? "" : "\n") + table.title + "\n";
        if (table.rows.empty()) {
            text += "  nothing\n";
        } else {
            text += table.rows.size() == 1 && table.columns.size() > widest ? tall_table(table, units)
                                                                            : wide_table(table, units);
        }
    }
    for (const std::string& note : answer.notes) text += "\n" + note + "\n";
    return text;
}

std::string json_of(const Answer& answer) {
    Json tables = Json::object();
    for (const AnswerTable& table : answer.tables) tables[table.name] = json_table(table);
    Json all = {{"tables", std::move(tables)}, {"notes", answer.notes}};
    if (const auto& moment = answer.moment)
        all["moment"] = {{"time", std::isfinite(moment->time) ? Json(moment->time) : Json(nullptr)},
                         {"step", moment->step ? Json(*moment->step) : Json(nullptr)},
                         {"how", moment->how}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_of(const Answer& answer) {
    std::string text;
    for (const AnswerTable& table : answer.tables) {
        if (!text.empty()) text += "\n";
        std::string head;
        for (const AnswerColumn& column : table.columns) {
            const std::string unit = si_unit(column);
            head += (head.empty() ? "" : ",") + csv_words(with_unit(column.name, unit));
        }
        text += head + (table.row_dimensions.empty() ? "" : ",unit") + "\n";
        auto dimension = table.row_dimensions.begin();
        for (const auto& row : table.rows) {
            for (std::size_t k = 0; k < row.size(); ++k) text += (k > 0 ? "," : "") + csv_cell(row[k]);
            if (!table.row_dimensions.empty()) text += "," + si_unit(*dimension++);
            text += "\n";
        }
    }
    return text;
}

}  // namespace grainreel
